//! The example graphs: what newcomers read and render first.

use ptlib::{ComputeOptions, Engine, EngineOptions};

use crate::picture::{Levels, folder};

#[test]
fn example_graphs_are_small_faultless_and_have_a_picture() {
    let engine = Engine::new(EngineOptions::default());
    let graphs = folder("../examples/graphs");
    let mut count = 0;
    for entry in std::fs::read_dir(&graphs).expect("the examples are there") {
        let path = entry.expect("the folder can be read").path();
        if path.extension() != Some("xml".as_ref()) {
            continue;
        }
        count += 1;
        let name = path.display();
        let bytes = std::fs::metadata(&path).expect("the file is there").len();
        assert!(bytes <= 4096, "{name} has {bytes} bytes");
        let reading = engine.open_graph(&path).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert!(reading.warnings.is_empty(), "{name}: {:?}", reading.warnings);
        let result = reading.graph.main_result().unwrap_or_else(|e| panic!("{name}: {e}"));
        let options = ComputeOptions { size: Some((64, 64)), ..Default::default() };
        let image = engine
            .compute(&reading.graph, result, 0, options)
            .unwrap_or_else(|e| panic!("{name}: {e}"));
        let samples = Levels::of(&image).samples;
        let (darkest, brightest) = (samples.iter().min(), samples.iter().max());
        assert!(darkest < brightest, "{name} is all of one colour");
        let picture = folder("../docs/gallery").join(path.file_stem().unwrap_or_default());
        assert!(picture.with_extension("jpg").exists(), "{name} has no picture in the gallery");
    }
    assert!(count >= 6, "only {count} examples are left");
}
