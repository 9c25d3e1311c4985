//! Reads any bytes as a file of muscles. Whatever is read must survive writing and reading again;
//! whatever is refused must say where.
#![no_main]

use libfuzzer_sys::fuzz_target;
use ptlib_aging::grammar::{Limits, Muscle, parse};

fuzz_target!(|text: &[u8]| {
    let limits = Limits::default();
    match parse(text, &limits) {
        Ok(muscles) => {
            assert!(muscles.len() <= limits.muscles);
            let written: String = muscles.iter().map(write).collect();
            let limits = Limits { bytes: usize::MAX, ..limits };
            let again = parse(written.as_bytes(), &limits).expect("what was written is readable");
            assert_eq!(again, muscles, "writing changed the muscles");
        }
        Err(faults) => {
            assert!(faults.count() > 0 && faults.list().len() <= faults.count());
            let lines = text.len() + 1;
            let is_inside = |place: usize| (1..=lines).contains(&place);
            for fault in faults.list() {
                assert!(is_inside(fault.line) && is_inside(fault.column), "{fault:?}");
            }
            assert!(faults.to_string().len() < 10_000, "{faults}");
        }
    }
});

/// A muscle as its file describes it, with all keys, on a line.
fn write(muscle: &Muscle) -> String {
    let Muscle { from, to, wrinkles, width, max_angle, low, amplitude } = muscle;
    format!(
        "! ma={:e};{:e} mb={:e};{:e} n={wrinkles} relwidth={width:e} maxangle={max_angle:e} \
         omegalow={low:e} amplitude={amplitude:e}\n",
        from[0], from[1], to[0], to[1]
    )
}
