//! How much memory the process uses.

use std::fs;

/// The bytes of memory that are in use, or nothing where the system does not tell it.
pub(crate) fn used() -> Option<u64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"))?;
    let kibibytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kibibytes * 1024)
}

#[cfg(test)]
mod tests {
    #[cfg(target_os = "linux")]
    #[test]
    fn memory_that_is_written_to_is_counted() {
        const SIZE: u32 = 64 << 20;
        let before = super::used().unwrap();
        let block = vec![1_u8; SIZE as usize];
        let after = super::used().unwrap();
        assert!(after > before + u64::from(SIZE / 2), "{before} {after} {}", block.len());
    }
}
