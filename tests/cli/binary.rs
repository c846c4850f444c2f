//! Hot loops are compiled with the vectors of their level: in the release binary, what is made for AVX2 and
//! AVX-512 neither computes in narrow vectors nor calls code that does, and stores no vector in part by
//! `vmaskmov`, which is slow on some CPUs.
//!
//! A function or closure on the way that is not marked `#[inline(always)]` is compiled for the baseline, and
//! gives the same bits many times slower; nothing else would notice.

use std::{
    collections::BTreeMap,
    env,
    io::{BufRead, BufReader},
    process::{Command, Stdio},
};

/// What is known of a function of the binary.
#[derive(Debug, Default, PartialEq)]
struct Function {
    name: String,
    /// Instructions that have no place in a hot loop.
    slow: Vec<String>,
    /// Divisions and roots of whole 256-bit or 512-bit vectors.
    wide: usize,
    /// Those of four f32.
    narrow: usize,
    /// Of 256-bit vectors of f64: roots, divisions and comparisons; roots of single f64; comparisons of 256-bit vectors
    /// of f32; and results of comparisons of f64 as bits.
    of_cloth: [usize; 6],
    /// Addresses of the functions that it calls.
    calls: Vec<u64>,
}

/// Operations of the fragment, depth and force loops on packed numbers.
const PACKED: [&str; 8] = ["add", "sub", "mul", "div", "sqrt", "max", "min", "cvt"];

/// Whether an instruction computes with packed numbers in vectors of the baseline: SSE, without the prefix `v`.
fn is_baseline(mnemonic: &str) -> bool {
    let packed = mnemonic.ends_with("ps") || mnemonic.ends_with("pd");
    packed && PACKED.iter().any(|operation| mnemonic.starts_with(operation))
}

/// Whether an instruction divides or takes roots, of four f32, or of vectors of 256 or 512 bits.
fn divides(mnemonic: &str, operands: &str) -> [bool; 2] {
    let single = ["vdivps", "vsqrtps"].contains(&mnemonic);
    let root = single || ["vdivpd", "vsqrtpd"].contains(&mnemonic);
    let wide = operands.contains("%ymm") || operands.contains("%zmm");
    [single && !wide, root && wide]
}

/// Which of the operations of [`Function::of_cloth`] an instruction is.
fn operation_of_cloth(mnemonic: &str, operands: &str) -> Option<usize> {
    let wide = operands.contains("%ymm");
    let compares = mnemonic.starts_with("vcmp") && wide;
    match mnemonic {
        "vsqrtpd" if wide => Some(0),
        "vdivpd" if wide => Some(1),
        _ if compares && mnemonic.ends_with("pd") => Some(2),
        _ if compares && mnemonic.ends_with("ps") => Some(4),
        "vsqrtsd" => Some(3),
        "vmovmskpd" if wide => Some(5),
        _ => None,
    }
}

/// The functions by address in what `objdump -d --no-show-raw-insn` prints.
fn functions(text: impl BufRead) -> BTreeMap<u64, Function> {
    let mut functions = BTreeMap::new();
    let mut current = 0;
    for line in text.lines().map(Result::unwrap) {
        if let Some((address, name)) = line.strip_suffix(">:").and_then(|line| line.split_once(" <")) {
            current = u64::from_str_radix(address, 16).unwrap();
            functions.insert(current, Function { name: name.to_owned(), ..Function::default() });
            continue;
        }
        let Some((_, instruction)) = line.split_once(":\t") else { continue };
        let (mnemonic, operands) = instruction.split_once(' ').unwrap_or((instruction, ""));
        let Some(function) = functions.get_mut(&current) else { continue };
        if is_baseline(mnemonic) || mnemonic.contains("maskmov") {
            function.slow.push(instruction.trim().to_owned());
        }
        let [narrow, wide] = divides(mnemonic, operands).map(usize::from);
        if let Some(operation) = operation_of_cloth(mnemonic, operands) {
            function.of_cloth[operation] += 1;
        }
        function.narrow += narrow;
        function.wide += wide;
        if mnemonic == "call" || mnemonic == "jmp" {
            let target = operands.trim().split(' ').next().and_then(|a| u64::from_str_radix(a, 16).ok());
            function.calls.extend(target.filter(|_| !operands.contains('+')));
        }
    }
    functions
}

/// What hot loops may call although it is compiled for the baseline, because it is seldom reached: panics,
/// lines, the list of a tile, springs over the stretch limit, points that hit an object, powers that are not whole. Nothing else of the
/// project may be called.
const COLD: [&str; 7] =
    ["core..panicking", "core9panicking", "draw_line", "in_tile", "shorten", "resolve_block", "4math3pow"];

/// What is slow in the copies for a level, how many of them there are, and their narrow and wide divisions.
fn slow_in(functions: &BTreeMap<u64, Function>, level: &str) -> (Vec<String>, [usize; 3]) {
    let copies: Vec<&Function> =
        functions.values().filter(|function| function.name.contains(level)).collect();
    let mut slow = Vec::new();
    for copy in &copies {
        slow.extend(copy.slow.iter().map(|instruction| format!("{}: {instruction}", copy.name)));
        for called in copy.calls.iter().filter_map(|address| functions.get(address)) {
            let cold = COLD.iter().any(|name| called.name.contains(name));
            if !cold && (called.name.contains("drape") || !called.slow.is_empty()) {
                slow.push(format!("{} calls {}", copy.name, called.name));
            }
        }
    }
    let sum = |of: fn(&Function) -> usize| copies.iter().map(|copy| of(copy)).sum();
    (slow, [copies.len(), sum(|copy| copy.narrow), sum(|copy| copy.wide)])
}

/// The functions of the program; `None`, after saying why, where they cannot be read.
fn of_the_program() -> Option<BTreeMap<u64, Function>> {
    let skip = |why: &str| {
        assert!(env::var_os("DRAPE_REQUIRE_OBJDUMP").is_none(), "{why}");
        #[expect(clippy::print_stdout, reason = "a check that cannot run says so")]
        {
            println!("not checked: {why}");
        }
        None
    };
    if !cfg!(target_arch = "x86_64") {
        return skip("only x86-64 has several levels of vectors");
    }
    if cfg!(debug_assertions) {
        return skip("only a release build has hot loops: cargo test --release");
    }
    let objdump = Command::new("objdump")
        .args(["--disassemble", "--no-show-raw-insn", env!("CARGO_BIN_EXE_drape")])
        .stdout(Stdio::piped())
        .spawn();
    let Ok(mut objdump) = objdump else {
        return skip("there is no objdump; on Debian it is in the package binutils");
    };
    let functions = functions(BufReader::new(objdump.stdout.take().unwrap()));
    assert!(objdump.wait().unwrap().success(), "objdump failed");
    Some(functions)
}

#[test]
fn hot_loops_are_compiled_for_their_level() {
    let Some(functions) = of_the_program() else { return };
    for level in ["vectorize_avx2", "vectorize_avx512"] {
        let (slow, [copies, narrow, wide]) = slow_in(&functions, level);
        println!("{level}: {copies} functions with {narrow} narrow and {wide} wide divisions and roots");
        assert!(slow.is_empty(), "{level}:\n{}", slow.join("\n"));
        assert!(copies >= 10 && wide >= 90, "{level}: only {copies} functions and {wide} wide divisions");
        // Loops over f32 and f64 at once have narrow ones.
        assert!(20 * narrow < wide, "{level}: {narrow} narrow divisions beside {wide}");
    }
}

/// How many copies for AVX2 there are of the loops over springs' forces, over the cells of self-collision, over those and
/// their neighbours, and over the springs that may be too long, each recognised by what only it computes with whole vectors.
fn cloth_loops(functions: &BTreeMap<u64, Function>) -> [usize; 4] {
    let copies = || functions.values().filter(|function| function.name.contains("vectorize_avx2"));
    let forces = |copy: &&Function| copy.of_cloth[0] >= 2 && copy.of_cloth[1] >= 2;
    let cells =
        |copy: &&Function| copy.of_cloth[..3] == [0; 3] && copy.of_cloth[3] >= 1 && copy.of_cloth[4] >= 1;
    let neighbors = |copy: &&Function| copy.of_cloth[..2] == [0; 2] && copy.of_cloth[5] >= 5;
    let limit = |copy: &&Function| {
        let called = copy.calls.iter().filter_map(|address| functions.get(address));
        copy.of_cloth[2] >= 2 && called.into_iter().any(|called| called.name.contains("shorten"))
    };
    let count = |is: &dyn Fn(&&Function) -> bool| copies().filter(|copy| is(copy)).count();
    [count(&forces), count(&cells), count(&neighbors), count(&limit)]
}

#[test]
fn the_loops_of_the_cloth_are_among_them() {
    let Some(functions) = of_the_program() else { return };
    let [forces, cells, neighbors, limit] = cloth_loops(&functions);
    assert_eq!(forces, 3, "forces with Verlet's scheme, forces apart, and the stiffness of springs");
    assert_eq!(
        [cells, neighbors, limit],
        [1; 3],
        "self-collision without and with neighbours, and the stretch limit"
    );
}

/// Functions of the C library whose bits differ between systems and processors.
const DIFFERING: [&str; 24] = [
    "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "sinh", "cosh", "tanh", "asinh", "acosh", "atanh",
    "sincos", "exp", "exp2", "expm1", "log", "log2", "log10", "log1p", "pow", "cbrt", "hypot",
];

/// Of those, the ones that the program imports: the progress bar's estimate of the remaining time takes a power, which
/// reaches no result.
const HARMLESS: [&str; 1] = ["pow"];

/// The functions that differ among the names that `objdump -T` prints.
fn differing(symbols: &str) -> Vec<&str> {
    let imported = symbols.lines().filter(|line| line.contains("*UND*"));
    let names = imported.filter_map(|line| line.split_whitespace().next_back());
    let differs =
        |name: &&str| DIFFERING.iter().any(|other| *name == *other || name.strip_suffix('f') == Some(other));
    names.filter(differs).collect()
}

#[test]
fn no_function_whose_bits_differ_is_imported() {
    let table = " 0000 DF *UND* 0000 (GLIBC_2.29) pow\n 0000 DF *UND* 0000 (GLIBC_2.2.5) powf\n \
                 0000 DF *UND* 0000 (GLIBC_2.2.5) posix_fadvise\n 0001 g DF .text 0002 Base sin\n";
    assert_eq!(differing(table), ["pow", "powf"]);
    if cfg!(not(target_os = "linux")) {
        return;
    }
    let program = assert_cmd::cargo::cargo_bin!("drape");
    let Ok(output) = Command::new("objdump").arg("-T").arg(program).output() else {
        assert!(env::var_os("DRAPE_REQUIRE_OBJDUMP").is_none(), "objdump is missing");
        return;
    };
    let symbols = String::from_utf8(output.stdout).expect("names");
    assert!(symbols.contains("memcpy"), "the table of imports is read: {symbols}");
    assert_eq!(differing(&symbols), HARMLESS);
}

#[test]
fn slow_code_is_found() {
    let listing = "\
0000000000001000 <vectorize_avx2>:\n    1000:\tvdivps %ymm0,%ymm1,%ymm2\n    1004:\tcall   2000 <drape..shade>\n\
    1008:\tcall   3000 <core..panicking>\n    100c:\tjmp    1004 <vectorize_avx2+0x4>\n\
0000000000002000 <drape..shade>:\n    2000:\tdivps  %xmm0,%xmm1\n\
0000000000003000 <core..panicking>:\n    3000:\tmulps  %xmm0,%xmm1\n\
0000000000004000 <vectorize_avx512>:\n    4000:\tvdivps %xmm0,%xmm1,%xmm2\n    4004:\tvmaskmovps %ymm0,%ymm1,(%rax)\n\
    4008:\tvdivpd %zmm0,%zmm1,%zmm2\n    400c:\tdivss  %xmm0,%xmm1\n";
    let functions = functions(listing.as_bytes());
    let avx2 = slow_in(&functions, "vectorize_avx2");
    assert_eq!(avx2, (vec!["vectorize_avx2 calls drape..shade".to_owned()], [1, 0, 1]));
    let avx512 = slow_in(&functions, "vectorize_avx512");
    let expected = "vectorize_avx512: vmaskmovps %ymm0,%ymm1,(%rax)".to_owned();
    assert_eq!(avx512, (vec![expected], [1, 1, 1]));
}
