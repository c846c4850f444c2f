//! Pictures and hashes that are kept under version control, and how they are compared and blessed.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use drape::math::StateHash;
use drape::output::compare::{Difference, triptych};
use drape::output::png::{self, Effort, Pixels};
use drape_lab::page::{self, comparison::Row};

/// Largest golden: files, and pixels along each side.
const MAX_BYTES: usize = 20 * 1024;
const MAX_SIDE: u32 = 256;

/// The file of hashes: a name and 16 hexadecimal digits a line.
const HASHES: &str = "hashes.txt";

/// The file of state hashes, of the same form.
const STATES: &str = "states.txt";

/// The file of reasons: for each golden and hash its name and why it was blessed last.
const REASONS: &str = "blessed.txt";

/// A folder of goldens, and how a run treats it.
pub(crate) struct Goldens {
    /// Where the goldens are.
    pub(crate) folder: PathBuf,
    /// Where a failure leaves expected, difference and actual side by side.
    pub(crate) failures: PathBuf,
    /// Why goldens are to be replaced, if they are.
    pub(crate) bless: Option<String>,
    /// Whether nobody watches this run.
    pub(crate) unattended: bool,
}

impl Goldens {
    /// Compares a picture with the golden called `name`, pixel by pixel and exactly.
    ///
    /// # Errors
    /// What differs and where to look; also that a golden is missing or was blessed just now.
    pub(crate) fn check(&self, name: &str, actual: &Pixels) -> Result<(), String> {
        let file = self.folder.join(format!("{name}.png"));
        let expected = file.exists().then(|| png::read(&file)).transpose().map_err(|e| e.to_string())?;
        if expected.as_ref() == Some(actual) {
            return Ok(());
        }
        if self.bless.is_some() {
            return self.bless(name, || self.write_picture(name, actual));
        }
        let Some(expected) = expected else {
            return Err(format!("{name}: there is no golden; DRAPE_BLESS=\"reason\" makes it"));
        };
        let difference = Difference::between(&expected, actual);
        let (differing, max) = (difference.differing(), difference.max());
        let verdict = format!("{differing} pixels differ by up to {max}");
        let shown = self.show(name, &verdict, [&expected, actual])?;
        Err(format!("{name}: {verdict}; see {}", shown.display()))
    }

    /// Leaves expected, difference and actual side by side, as a picture and as a page.
    fn show(&self, name: &str, verdict: &str, pictures: [&Pixels; 2]) -> Result<PathBuf, String> {
        let [expected, actual] = pictures;
        save(&self.failures.join(format!("{name}.png")), &triptych(expected, actual), Effort::Fast)?;
        let row = Row { title: name, verdict, pictures }.html().map_err(|e| e.to_string())?;
        let file = self.failures.join(format!("{name}.html"));
        fs::write(&file, (page::head("A golden that differs") + &row + page::END).as_bytes())
            .map_err(|e| e.to_string())?;
        Ok(file)
    }

    /// Compares the hash of a picture with the one kept under `name`.
    ///
    /// # Errors
    /// As [`Goldens::check`].
    pub(crate) fn check_hash(&self, name: &str, actual: &Pixels) -> Result<(), String> {
        self.check_entry(HASHES, name, &format!("{:016x}", hash(actual)))
    }

    /// Compares the hash of a state with the one kept under `name`.
    ///
    /// # Errors
    /// As [`Goldens::check`].
    pub(crate) fn check_state(&self, name: &str, hash: &str) -> Result<(), String> {
        self.check_entry(STATES, name, hash)
    }

    fn check_entry(&self, file: &str, name: &str, hash: &str) -> Result<(), String> {
        let expected = self.entries(file).remove(name);
        if expected.as_deref() == Some(hash) {
            return Ok(());
        }
        if self.bless.is_some() {
            return self.bless(name, || self.set(file, name, hash));
        }
        match expected {
            None => Err(format!("{name}: there is no hash in {file}; DRAPE_BLESS=\"reason\" makes it")),
            Some(expected) => Err(format!("{name}: the hash is {hash}, not {expected} as in {file}")),
        }
    }

    /// The names that have a golden, a hash, a state hash and a reason.
    pub(crate) fn names(&self) -> [Vec<String>; 4] {
        let files = fs::read_dir(&self.folder).into_iter().flatten().flatten();
        let name = |entry: fs::DirEntry| entry.file_name().to_string_lossy().into_owned();
        let texts = [HASHES, STATES, REASONS];
        let mut pictures: Vec<_> = files.map(name).filter(|name| !texts.contains(&name.as_str())).collect();
        pictures.sort();
        [pictures, self.keys(HASHES), self.keys(STATES), self.keys(REASONS)]
    }

    /// Replaces a golden for a stated reason. The run fails all the same, so that no run that
    /// changes what it compares with is ever green.
    fn bless(&self, name: &str, replace: impl FnOnce() -> Result<(), String>) -> Result<(), String> {
        let reason = self.bless.as_deref().unwrap_or_default().trim();
        if self.unattended {
            return Err(format!("{name}: goldens are not blessed where CI is set"));
        }
        if reason.is_empty() {
            return Err(format!("{name}: a golden is blessed for a reason: DRAPE_BLESS=\"reason\""));
        }
        replace()?;
        self.set(REASONS, name, reason)?;
        Err(format!("{name}: blessed; look at it and run again without DRAPE_BLESS"))
    }

    fn write_picture(&self, name: &str, picture: &Pixels) -> Result<(), String> {
        let bytes = encode(picture, Effort::Small)?;
        if bytes.len() > MAX_BYTES || picture.width.max(picture.height) > MAX_SIDE {
            let (width, height) = (picture.width, picture.height);
            return Err(format!("{name}: {width} x {height} and {} bytes are too large", bytes.len()));
        }
        fs::write(self.folder.join(format!("{name}.png")), &bytes).map_err(|e| e.to_string())
    }

    fn entries(&self, file: &str) -> BTreeMap<String, String> {
        let text = fs::read_to_string(self.folder.join(file)).unwrap_or_default();
        let pairs = text.lines().filter_map(|line| line.split_once(' '));
        pairs.map(|(name, value)| (name.to_owned(), value.to_owned())).collect()
    }

    fn keys(&self, file: &str) -> Vec<String> {
        self.entries(file).into_keys().collect()
    }

    fn set(&self, file: &str, name: &str, value: &str) -> Result<(), String> {
        // Tests run side by side, and both read and write the file of reasons.
        static WRITING: Mutex<()> = Mutex::new(());
        let _alone = WRITING.lock();
        let mut entries = self.entries(file);
        entries.insert(name.to_owned(), value.to_owned());
        let text: String = entries.iter().map(|(name, value)| format!("{name} {value}\n")).collect();
        fs::write(self.folder.join(file), text.as_bytes()).map_err(|e| e.to_string())
    }
}

/// Whether a golden file keeps the bounds of size.
///
/// # Errors
/// The bound that it breaks.
pub(crate) fn check_size(file: &Path) -> Result<(), String> {
    let bytes = fs::metadata(file).map_err(|e| e.to_string())?.len();
    let picture = png::read(file).map_err(|e| e.to_string())?;
    if bytes > MAX_BYTES as u64 || picture.width.max(picture.height) > MAX_SIDE {
        return Err(format!("{}: {} x {}, {bytes} bytes", file.display(), picture.width, picture.height));
    }
    Ok(())
}

/// Writes a picture, making its folder if need be.
///
/// # Errors
/// Why it cannot be written.
pub(crate) fn save(file: &Path, picture: &Pixels, effort: Effort) -> Result<(), String> {
    fs::create_dir_all(file.parent().unwrap_or(file)).map_err(|e| e.to_string())?;
    fs::write(file, &encode(picture, effort)?).map_err(|e| e.to_string())
}

/// A picture at half its width and height; each pixel is the mean of four, rounded.
pub(crate) fn half(picture: &Pixels) -> Pixels {
    let (width, height) = (picture.width / 2, picture.height / 2);
    let at = |x: u32, y: u32| picture.rgba[(y * picture.width + x) as usize];
    let mean = |x: u32, y: u32| {
        let four = [at(x, y), at(x + 1, y), at(x, y + 1), at(x + 1, y + 1)];
        let sum = |channel: usize| four.iter().map(|pixel| u32::from(pixel[channel])).sum::<u32>();
        [0, 1, 2, 3].map(|channel| u8::try_from((sum(channel) + 2) / 4).unwrap_or(u8::MAX))
    };
    let rgba = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    Pixels { width, height, rgba: rgba.map(|(x, y)| mean(2 * x, 2 * y)).collect() }
}

/// Opaque pictures are kept without alpha.
fn encode(picture: &Pixels, effort: Effort) -> Result<Vec<u8>, String> {
    let rgb: Vec<u8> = picture.rgba.iter().flat_map(|&[r, g, b, _]| [r, g, b]).collect();
    let opaque = picture.rgba.iter().all(|pixel| pixel[3] == 255);
    let samples = if opaque { &rgb } else { picture.rgba.as_flattened() };
    png::encode(picture.width, picture.height, samples, effort).map_err(|e| e.to_string())
}

/// The hash of a picture: its width, its height, then its pixels' red, green, blue and alpha.
fn hash(picture: &Pixels) -> u64 {
    let mut hash = StateHash::default();
    hash.write(&picture.width.to_le_bytes());
    hash.write(&picture.height.to_le_bytes());
    hash.write(picture.rgba.as_flattened());
    hash.finish()
}
