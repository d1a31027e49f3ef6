//! predicates <- meshing <- tracking <- fluids <- cli, nothing depends on tests, and what is LGPL stays out of products.

use crate::tree::{report, root};
use serde_json::Value;
use std::process::Command;

/// The products, each with the packages of the workspace that it may depend on.
const MAY_USE: [(&str, &[&str]); 5] = [
    ("welter-predicates", &[]),
    ("welter-meshing", &["welter-predicates"]),
    ("welter-tracking", &["welter-predicates", "welter-meshing"]),
    ("welter-fluids", &["welter-predicates", "welter-meshing", "welter-tracking"]),
    ("welter", &["welter-predicates", "welter-meshing", "welter-tracking", "welter-fluids"]),
];

struct Dependency {
    package: String,
    name: String,
    optional: bool,
    development: bool,
}

/// Every dependency that a package of the workspace declares, as cargo reads the manifests.
fn declared() -> Vec<Dependency> {
    let cargo = std::env::var("CARGO").unwrap_or_else(|_| "cargo".to_owned());
    let output = Command::new(cargo)
        .args(["metadata", "--no-deps", "--format-version", "1", "--offline"])
        .current_dir(root())
        .output()
        .unwrap();
    assert!(output.status.success(), "cargo metadata: {}", String::from_utf8_lossy(&output.stderr));
    let metadata: Value = serde_json::from_slice(&output.stdout).unwrap();
    let text = |value: &Value| value.as_str().unwrap_or_default().to_owned();
    let mut all = Vec::new();
    for package in metadata["packages"].as_array().unwrap() {
        for dependency in package["dependencies"].as_array().unwrap() {
            all.push(Dependency {
                package: text(&package["name"]),
                name: text(&dependency["name"]),
                optional: dependency["optional"].as_bool().unwrap(),
                development: dependency["kind"] == "dev",
            });
        }
    }
    assert!(all.len() > 20, "the manifests were not read");
    all
}

#[test]
fn dependencies_point_one_way() {
    let mut faults = Vec::new();
    for dependency in declared().iter().filter(|d| d.name == "welter" || d.name.starts_with("welter-")) {
        let Dependency { package, name, .. } = dependency;
        let allowed = match MAY_USE.iter().find(|(product, _)| product == package) {
            Some((_, may_use)) => may_use.contains(&name.as_str()),
            // Tests may use all products and ask for their own features, benchmarks the products and the kit.
            None => {
                MAY_USE.iter().any(|(product, _)| product == name)
                    || package == name
                    || package == "welter-benches"
            }
        };
        if !allowed {
            faults.push(format!("{package} depends on {name}"));
        }
    }
    report("predicates <- meshing <- tracking <- fluids <- cli", &faults);
}

#[test]
fn predicates_require_nothing() {
    let faults: Vec<String> = declared()
        .into_iter()
        .filter(|d| d.package == "welter-predicates" && !d.optional)
        .map(|d| format!("welter-predicates requires {}", d.name))
        .collect();
    report("the predicates have no required dependency", &faults);
}

#[test]
fn copyleft_and_peers_stay_in_tests_and_benchmarks() {
    let outside =
        ["rug", "gmp-mpfr-sys", "robust", "geometry-predicates", "parry3d-f64", "criterion", "proptest"];
    let faults: Vec<String> = declared()
        .into_iter()
        .filter(|d| {
            outside.contains(&d.name.as_str()) && MAY_USE.iter().any(|(product, _)| *product == d.package)
        })
        .filter(|d| !d.development || d.name == "rug" || d.name == "gmp-mpfr-sys")
        .map(|d| format!("{} depends on {}", d.package, d.name))
        .collect();
    report("rug and the benchmark peers are used in tests/, benches/ and fuzz/ alone", &faults);
}
