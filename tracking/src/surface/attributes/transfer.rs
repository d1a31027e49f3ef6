//! From where values come in one change: [`Transfer`].

/// One source of one target. A target's entries make its row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Entry {
    pub(crate) target: u32,
    pub(crate) source: u32,
    pub(crate) interpolation: f64,
    pub(crate) share: f64,
    /// Whether the target's direction is opposite to that of the source.
    pub(crate) reversed: bool,
    /// The sum of the shares of the same source in the rows before.
    pub(crate) share_before: f64,
    /// Whether no share of the same source follows.
    pub(crate) last: bool,
}

impl Entry {
    pub(crate) fn new(target: u32, source: u32, interpolation: f64, share: f64) -> Self {
        Self { target, source, interpolation, share, reversed: false, share_before: 0.0, last: false }
    }
}

/// An element that goes, and the neighbours that would take over its values.
#[derive(Clone, Debug)]
pub(crate) struct Departure {
    pub(crate) id: u32,
    pub(crate) heirs: Vec<u32>,
    /// Who takes over if none of the heirs lives.
    pub(crate) others: Vec<u32>,
}

/// The rows of one change.
#[derive(Clone, Debug, Default)]
pub(crate) struct Transfer {
    /// By target, each row in the order in which its sources were named.
    pub(crate) rows: Vec<Entry>,
    /// New elements, whether they have a row or not.
    pub(crate) births: Vec<u32>,
}

impl Transfer {
    /// Completes the entries that an operation names:
    /// * entries of targets that went in the same change are dropped; their shares stay with the source;
    /// * shares of sources that went, as far as nobody got them, go to the nearest heirs, equally;
    /// * a target that was there before and does not name itself is its own foremost source.
    pub(crate) fn complete(
        entries: Vec<Entry>,
        births: Vec<u32>,
        departures: &[Departure],
        lives: impl Fn(u32) -> bool,
    ) -> Self {
        let mut left: Vec<(u32, f64)> = Vec::new();
        let mut rows: Vec<Entry> = Vec::with_capacity(entries.len() + 4);
        for entry in entries {
            if lives(entry.target) {
                rows.push(entry);
            } else if entry.share != 0.0 {
                left.push((entry.source, entry.share));
            }
        }
        for departure in departures {
            let given = rows.iter().any(|entry| entry.source == departure.id && entry.share != 0.0);
            if !given && !left.iter().any(|&(source, _)| source == departure.id) {
                left.push((departure.id, 1.0));
            }
        }
        let named = rows.len();
        for (source, share) in left {
            if lives(source) {
                let own = rows.iter_mut().find(|entry| entry.source == source && entry.target == source);
                if let Some(own) = own {
                    own.share += share;
                }
                continue;
            }
            let heirs = heirs(source, departures, &rows[..named], &lives);
            let each = share / heirs.len() as f64;
            rows.extend(heirs.into_iter().map(|heir| Entry::new(heir, source, 0.0, each)));
        }
        let mut known: Vec<u32> = births.clone();
        known.extend(rows.iter().filter(|entry| entry.source == entry.target).map(|entry| entry.target));
        known.sort_unstable();
        let mut targets: Vec<u32> = rows.iter().map(|entry| entry.target).collect();
        targets.sort_unstable();
        targets.dedup();
        targets.retain(|target| known.binary_search(target).is_err());
        let mut own: Vec<Entry> =
            targets.into_iter().map(|target| Entry::new(target, target, 1.0, 1.0)).collect();
        own.extend(rows);
        own.sort_by_key(|entry| entry.target);
        Self::number_shares(&mut own);
        Self { rows: own, births }
    }

    fn number_shares(rows: &mut [Entry]) {
        let mut order: Vec<usize> = (0..rows.len()).filter(|&i| rows[i].share != 0.0).collect();
        order.sort_by_key(|&i| rows[i].source);
        for (k, &i) in order.iter().enumerate() {
            let source = rows[i].source;
            let before = k.checked_sub(1).map(|k| rows[order[k]]).filter(|entry| entry.source == source);
            rows[i].share_before = before.map_or(0.0, |entry| entry.share_before + entry.share);
            rows[i].last = order.get(k + 1).is_none_or(|&next| rows[next].source != source);
        }
    }
}

/// Who takes over from an element that went: those of its heirs that live, and those that got something of the
/// others; else the same of the others at hand, and then of the heirs of heirs. Nobody if all that is linked to it
/// went.
fn heirs(id: u32, departures: &[Departure], named: &[Entry], lives: &impl Fn(u32) -> bool) -> Vec<u32> {
    let departure = |id: u32| departures.iter().find(|departure| departure.id == id);
    let mut seen = vec![id];
    let mut wave: Vec<u32> = departure(id).map_or_else(Vec::new, |departure| departure.heirs.clone());
    let mut others: Vec<u32> = departure(id).map_or_else(Vec::new, |departure| departure.others.clone());
    loop {
        let successors = |&heir: &u32| {
            let from = named.iter().filter(move |entry| entry.source == heir && entry.share != 0.0);
            let own = lives(heir).then_some(heir);
            own.into_iter()
                .chain(from.filter(|_| own.is_none()).map(|entry| entry.target))
                .collect::<Vec<u32>>()
        };
        let mut found: Vec<u32> = wave.iter().flat_map(successors).collect();
        found.sort_unstable();
        found.dedup();
        if !found.is_empty() {
            return found;
        }
        let beyond = wave.iter().filter_map(|&heir| departure(heir));
        others.extend(beyond.flat_map(|departure| departure.heirs.iter().chain(&departure.others)));
        seen.append(&mut wave);
        wave = std::mem::take(&mut others);
        wave.retain(|heir| !seen.contains(heir));
        wave.sort_unstable();
        wave.dedup();
        if wave.is_empty() {
            return Vec::new();
        }
    }
}
