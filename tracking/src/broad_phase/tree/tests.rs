//! The invariants of the tree after any changes.

use super::*;
use std::collections::BTreeMap;

/// The first output of splitmix64 from the next state.
fn random(state: &mut u64) -> u64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let z = (*state ^ (*state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    (z ^ (z >> 27)) >> 11
}

fn unit(state: &mut u64) -> f64 {
    random(state) as f64 / 2f64.powi(53)
}

/// Every invariant of the module, and exactly the boxes of `expected`.
fn check(tree: &Tree, expected: &BTreeMap<u32, Box3>) {
    assert_eq!(tree.len(), expected.len());
    let in_use = if tree.root == NONE { 0 } else { 2 * tree.len() - 1 };
    assert_eq!(tree.nodes.len() - tree.free.len(), in_use);
    assert!(!tree.ordered || tree.free.is_empty());
    let mut stack: Vec<(u32, u32, usize)> =
        Some(tree.root).filter(|&r| r != NONE).map(|r| (r, NONE, 0)).into_iter().collect();
    let mut found = BTreeMap::new();
    while let Some((at, parent, depth)) = stack.pop() {
        let node = tree.nodes[at as usize];
        assert_eq!(node.parent, parent);
        assert!(depth as f64 <= (tree.len() as f64).ln() / (4.0_f64 / 3.0).ln() + 1e-9, "depth {depth}");
        if node.is_leaf() {
            assert_eq!(tree.leaf_of[node.children[0] as usize], at);
            assert_eq!(found.insert(node.children[0], node.bounds), None);
            continue;
        }
        let children = node.children.map(|child| tree.nodes[child as usize]);
        assert_eq!(node.leaves, children[0].leaves + children[1].leaves);
        assert!(!tree.ordered || node.children == [at + 1, at + 2 * children[0].leaves]);
        assert_eq!(node.bounds, children[0].bounds.union(&children[1].bounds));
        assert!(children.iter().all(|child| 4 * child.leaves <= 3 * node.leaves));
        stack.extend(node.children.map(|child| (child, at, depth + 1)));
    }
    assert_eq!(&found, expected);
    let absent = tree.leaf_of.iter().filter(|&&leaf| leaf != NONE).count();
    assert_eq!(absent, expected.len());
}

/// A box of one of these kinds: anywhere, at one place, on a line ever farther, or as large as all.
fn some_box(state: &mut u64, kind: u64, step: usize) -> Box3 {
    let mut point = || DVec3::new(unit(state), unit(state), unit(state));
    let (at, size) = (point(), 0.1 * point());
    match kind {
        0 => Box3 { min: at, max: at + size },
        1 => Box3::of([DVec3::ONE]),
        2 => Box3::of([DVec3::new(step as f64, 0.0, 0.0), DVec3::new(step as f64 + 1.5, 0.0, 0.0)]),
        _ => Box3 { min: DVec3::ZERO, max: DVec3::splat(1000.0) },
    }
}

#[test]
fn no_sequence_of_changes_breaks_the_tree() {
    for kinds in [&[0][..], &[1], &[2], &[3, 0], &[0, 1, 2, 3]] {
        let mut state = 1;
        let mut boxes = BTreeMap::new();
        let mut tree = Tree::new(std::iter::empty(), |_| Box3::EMPTY);
        check(&tree, &boxes);
        for step in 0..3000 {
            // It grows, and shrinks to nothing.
            let limit = if step < 2000 { 400 } else { (2980 - step.min(2980)) as u64 / 3 };
            let element = (random(&mut state) % 400) as u32;
            if u64::from(element) < limit && random(&mut state) & 3 != 0 {
                let kind = kinds[random(&mut state) as usize % kinds.len()];
                let bounds = some_box(&mut state, kind, step);
                tree.set(element, bounds);
                boxes.insert(element, bounds);
            } else {
                let element = if step < 2000 { element } else { 399 - (step - 2000) as u32 * 4 / 9 % 400 };
                tree.remove(element);
                boxes.remove(&element);
            }
            if step % 7 == 0 || step > 2900 {
                check(&tree, &boxes);
                let query = some_box(&mut state, kinds[0], step);
                let near =
                    boxes.iter().filter(|(_, b)| !super::super::gap::apart(b, &query, 0.25)).map(|(&e, _)| e);
                assert_eq!(tree.near(&query, 0.25, |_| true), near.collect::<Vec<_>>());
            }
            if step % 500 == 250 {
                // As when a surface is numbered without gaps.
                let old: Vec<u32> = boxes.keys().copied().collect();
                tree.rename(old.iter().copied());
                boxes = (0..).zip(boxes.into_values()).collect();
                check(&tree, &boxes);
            }
            if step % 500 == 499 {
                boxes.values_mut().for_each(|b| *b = some_box(&mut state, kinds[0], step));
                tree.refresh(|e| boxes[&e]);
                check(&tree, &boxes);
            }
        }
    }
}

#[test]
fn elements_that_come_in_order_do_not_make_a_list() {
    let mut tree = Tree::new(std::iter::empty(), |_| Box3::EMPTY);
    let mut boxes = BTreeMap::new();
    for i in 0..20_000 {
        let bounds = if i < 10_000 { Box3::of([DVec3::splat(f64::from(i))]) } else { Box3::of([DVec3::ONE]) };
        tree.set(i, bounds);
        boxes.insert(i, bounds);
    }
    check(&tree, &boxes);
}

#[test]
fn a_tree_is_built_anew_only_when_its_boxes_have_grown() {
    let mut state = 7;
    let points: Vec<DVec3> =
        (0..5000).map(|_| DVec3::new(unit(&mut state), unit(&mut state), unit(&mut state))).collect();
    let at = |scale: f64| {
        let points = &points;
        move |e: u32| Box3::of([points[e as usize] * scale])
    };
    let mut tree = Tree::new(0..5000, at(1.0));
    let shape = |tree: &Tree| tree.nodes.iter().map(|node| node.children).collect::<Vec<_>>();
    let size = |tree: &Tree| {
        let bounds = |e: u32| *tree.bounds(e).expect("an element of the tree");
        refit(&mut tree.nodes.clone(), &bounds).size
    };
    let (before, small) = (shape(&tree), size(&tree));
    assert_eq!(small, tree.built_size);
    tree.refresh(at(8.0));
    assert_eq!((shape(&tree), size(&tree)), (before.clone(), small), "nothing but the scale has changed");
    let shuffled = |e: u32| Box3::of([points[(e as usize * 2111) % 5000]]);
    tree.refresh(shuffled);
    assert_ne!(shape(&tree), before);
    check(&tree, &(0..5000).map(|e| (e, shuffled(e))).collect());
    assert_eq!(size(&tree), tree.built_size);
    assert!(size(&tree) < 1.1 * small);
}
