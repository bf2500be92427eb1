//! Scenes and trajectories in files.

use bryla::scene::file::Format;
use bryla::{RunOptions, Scene, Trajectory};

#[test]
fn every_scene_of_the_catalogue_survives_both_formats() {
    for name in bryla::catalogue::NAMES {
        let scene = bryla::catalogue::scene(name).unwrap().unwrap();
        for format in [Format::Toml, Format::Json] {
            let text = scene.to_text(format).unwrap();
            assert_eq!(Scene::from_text(&text, format).unwrap(), scene, "{name}:\n{text}");
        }
        assert!(scene.explain().unwrap().starts_with("Plan: "), "{name}");
    }
}

#[test]
fn every_file_of_the_examples_runs() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/scenes");
    let mut seen = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let mesh = path.file_stem().is_some_and(|stem| stem == "wrench");
        if path.extension().is_none_or(|e| e != "toml") || (mesh && !cfg!(feature = "mesh")) {
            continue;
        }
        seen += 1;
        let scene = Scene::load(&path).unwrap();
        let span = scene.run.t_span.unwrap();
        let run = scene
            .run([span[0], span[0] + 0.05 * (span[1] - span[0])], &RunOptions { t_eval: None, ..scene.run.clone() })
            .unwrap();
        assert_eq!(run.report().met, Some(true), "{}: {}", path.display(), run.report());
    }
    assert!(seen >= bryla::catalogue::NAMES.len());
}

fn written(run: &Trajectory, name: &str) -> Vec<u8> {
    let folder = std::env::temp_dir().join(format!("bryla-files-{}", std::process::id()));
    let path = folder.join(name);
    run.write(&path).unwrap();
    std::fs::read(path).unwrap()
}

#[test]
fn trajectories_are_written_with_all_their_digits() {
    let scene = bryla::catalogue::bouncing_die().unwrap();
    let run = scene.run(0.0..0.5, &RunOptions::method(bryla::Method::Rk4).step(1e-3)).unwrap();

    let text = String::from_utf8(written(&run, "run.csv")).unwrap();
    let mut lines = text.lines();
    let header: Vec<_> = lines.next().unwrap().split(',').collect();
    let column = header.iter().position(|name| *name == "die.position.z").unwrap();
    let rows: Vec<Vec<f64>> = lines.map(|line| line.split(',').map(|x| x.parse().unwrap()).collect()).collect();
    assert_eq!((rows.len(), rows[0].len()), (201, header.len()));
    for (sample, row) in rows.iter().enumerate() {
        assert_eq!((row[0], row[column]), (run.times()[sample], run.states(sample)[1].position.z));
    }

    let json: serde_json::Value = serde_json::from_slice(&written(&run, "run.json")).unwrap();
    assert_eq!(json["bodies"], serde_json::json!(["table", "die"]));
    assert_eq!(json["samples"]["position"][7][1][2].as_f64().unwrap(), run.states(7)[1].position.z);
    assert_eq!(json["events"][0]["time"].as_f64().unwrap(), run.events()[0].time);

    let error = run.write("run.xyz").unwrap_err().to_string();
    assert!(error.starts_with("run.xyz: a trajectory is written as one of .csv, .json"), "{error}");
}

#[cfg(feature = "schema")]
#[test]
fn the_schema_knows_every_key() {
    let schema = Scene::schema();
    let text = schema.to_string();
    for key in ["half_extents", "uniform_gravity", "point_body", "restitution", "t_span", "planar"] {
        assert!(text.contains(key), "{key}");
    }
    assert_eq!(schema["additionalProperties"], serde_json::Value::Bool(false));
}
