//! VTI files, read back by a small reader of its own.

use std::collections::BTreeMap;
use welter_kit::entropy::{Entropy, stream};
use welter_meshing::grid::Grid3;
use welter_meshing::io::{DataArray, VtkEncoding, write_vti};

/// What the reader finds: the attributes of the image, and the arrays of points and cells.
struct Image {
    attributes: BTreeMap<String, String>,
    arrays: Vec<(String, usize, Vec<f64>)>,
}

fn attributes(tag: &str) -> BTreeMap<String, String> {
    let unescape = |text: &str| {
        text.replace("&lt;", "<").replace("&gt;", ">").replace("&quot;", "\"").replace("&amp;", "&")
    };
    let mut rest = tag;
    let mut found = BTreeMap::new();
    while let Some((before, after)) = rest.split_once("=\"") {
        let (value, after) = after.split_once('"').unwrap();
        found.insert(before.split_whitespace().last().unwrap().to_owned(), unescape(value));
        rest = after;
    }
    found
}

fn of_base64(text: &str) -> Vec<u8> {
    let digit = |c: u8| match c {
        b'A'..=b'Z' => c - b'A',
        b'a'..=b'z' => c - b'a' + 26,
        b'0'..=b'9' => c - b'0' + 52,
        b'+' => 62,
        _ => 63,
    };
    let (mut bits, mut count, mut bytes) = (0_u32, 0, Vec::new());
    for c in text.bytes().filter(|&c| c != b'=') {
        bits = bits << 6 | u32::from(digit(c));
        count += 6;
        if count >= 8 {
            count -= 8;
            bytes.push((bits >> count) as u8);
            bits &= (1 << count) - 1;
        }
    }
    bytes
}

/// The numbers of a block behind its length.
fn block(bytes: &[u8]) -> Vec<f64> {
    let (length, rest) = bytes.split_first_chunk::<8>().unwrap();
    let length = u64::from_le_bytes(*length) as usize;
    let numbers = rest[..length].as_chunks::<8>().0;
    numbers.iter().map(|&number| f64::from_le_bytes(number)).collect()
}

fn read(file: &[u8]) -> Image {
    let marker = b"encoding=\"raw\">\n_";
    let raw = file.windows(marker.len()).position(|window| window == marker);
    let (xml, appended) = match raw {
        Some(at) => (&file[..at], &file[at + marker.len()..]),
        None => (file, &file[..0]),
    };
    let xml = std::str::from_utf8(xml).unwrap();
    let image = xml.split("<ImageData ").nth(1).unwrap();
    let arrays = image.split("<DataArray ").skip(1).map(|element| {
        // Names are escaped, so the tag ends at the first bracket.
        let (tag, body) = element.split_once('>').unwrap();
        let tag = attributes(tag);
        let body = body.split("</DataArray>").next().unwrap().trim();
        let values = match tag["format"].as_str() {
            "ascii" => body.split_whitespace().map(|word| word.parse().unwrap()).collect(),
            "binary" => block(&of_base64(body)),
            _ => block(&appended[tag["offset"].parse::<usize>().unwrap()..]),
        };
        (tag["Name"].clone(), tag["NumberOfComponents"].parse().unwrap(), values)
    });
    let arrays = arrays.collect();
    Image { attributes: attributes(image.split_once('>').unwrap().0), arrays }
}

#[test]
fn numbers_come_back_bit_for_bit_in_every_encoding() {
    let grid = Grid3::new([-0.5, 1e6, -0.0], 0.125, [3, 2, 4]).unwrap();
    let (nodes, cells) = (grid.node_count(), grid.cell_count());
    let bytes = stream(3, 5000);
    let mut entropy = Entropy::new(&bytes);
    let mut numbers = |n: usize| -> Vec<f64> {
        let mut next = || f64::from_bits(entropy.word());
        (0..n).map(|_| std::iter::repeat_with(&mut next).find(|x| x.is_finite()).unwrap()).collect()
    };
    let (first, second, inside) = (numbers(nodes), numbers(3 * nodes), numbers(cells));
    let points = [
        DataArray::scalars("distance <a & \"b\">", &first),
        DataArray { name: "velocity", values: &second, components: 3 },
    ];
    let cells = [DataArray::scalars("volume", &inside)];
    for encoding in [VtkEncoding::Appended, VtkEncoding::Base64, VtkEncoding::Ascii] {
        let mut file = Vec::new();
        write_vti(&mut file, &grid, &points, &cells, encoding).unwrap();
        let image = read(&file);
        assert_eq!(image.attributes["WholeExtent"], "0 3 0 2 0 4");
        assert_eq!(image.attributes["Spacing"], "0.125 0.125 0.125");
        assert_eq!(image.attributes["Origin"], "-0.5 1000000 -0");
        let names: Vec<&str> = image.arrays.iter().map(|(name, ..)| name.as_str()).collect();
        assert_eq!(names, ["distance <a & \"b\">", "velocity", "volume"]);
        for ((_, components, values), (expected, n)) in
            image.arrays.iter().zip([(&first, 1), (&second, 3), (&inside, 1)])
        {
            assert_eq!(*components, n);
            let bits = |values: &[f64]| values.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
            assert_eq!(bits(values), bits(expected), "{encoding:?}");
        }
    }
}
