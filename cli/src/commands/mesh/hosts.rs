//! Where the surface is in the mesh, as a table: for each of its vertices a cell, the vertices of this cell, and their weights.

use super::product::Product;
use std::fmt::Write as _;
use std::io::{self, Write};

/// Writes a line for each vertex of the surface: its number, that of its cell, the vertices of the cell in the file of the mesh, and
/// weights whose sum is 1. The position of the vertex is the sum of theirs times weights. Vertices of no triangle have no line.
pub(super) fn write_hosts(output: &mut dyn Write, product: &Product) -> io::Result<()> {
    let (cell, corners) = if product.tetrahedra.is_some() { ("tetrahedron", 4) } else { ("hexahedron", 8) };
    let mut line = format!("vertex,{cell}");
    for name in ["v", "w"] {
        (0..corners).for_each(|k| {
            let _ = write!(line, ",{name}{k}");
        });
    }
    writeln!(output, "{line}")?;
    let hosts = product.volume.hosts.vertices.iter().enumerate();
    for (vertex, host) in hosts.filter(|(_, host)| host.hexahedron != u32::MAX) {
        line.clear();
        let hexahedron = host.hexahedron as usize;
        match &product.tetrahedra {
            None => {
                let _ = write!(line, "{vertex},{hexahedron}");
                push(&mut line, &product.volume.mesh.hexahedra()[hexahedron], &host.weights());
            }
            Some(tetrahedra) => {
                let found = tetrahedra.locate(hexahedron, host.at).expect("hosts lie in their hexahedra");
                let _ = write!(line, "{vertex},{}", found.tetrahedron);
                push(&mut line, &tetrahedra.mesh().tetrahedra[found.tetrahedron], &found.weights);
            }
        }
        writeln!(output, "{line}")?;
    }
    Ok(())
}

fn push(line: &mut String, vertices: &[u32], weights: &[f64]) {
    for vertex in vertices {
        let _ = write!(line, ",{vertex}");
    }
    for weight in weights {
        let _ = write!(line, ",{weight}");
    }
}
