//! Edges as lines.

use rustc_hash::FxHashMap;

/// Lines along all edges, each edge once: through vertices with two of them, from one other vertex to the next, or around. The longest
/// first.
pub(super) fn chains(edges: &[[u32; 2]]) -> Vec<Vec<u32>> {
    let mut at: FxHashMap<u32, Vec<usize>> = FxHashMap::default();
    for (e, ends) in edges.iter().enumerate() {
        ends.iter().for_each(|v| at.entry(*v).or_default().push(e));
    }
    let goes_on = |v: u32| at.get(&v).is_some_and(|edges| edges.len() == 2);
    let mut taken = vec![false; edges.len()];
    let mut lines = Vec::new();
    // Lines with ends first, so that what is left are circles.
    for around in [false, true] {
        for (e, ends) in edges.iter().enumerate() {
            let start = if around { Some(ends[0]) } else { ends.iter().copied().find(|&v| !goes_on(v)) };
            let Some(start) = start.filter(|_| !taken[e]) else { continue };
            let mut line = vec![start];
            let (mut edge, mut v) = (e, start);
            loop {
                taken[edge] = true;
                let [a, b] = edges[edge];
                v = if a == v { b } else { a };
                line.push(v);
                // Only where two edges meet: many may meet elsewhere.
                let next = goes_on(v).then(|| at[&v].iter().copied().find(|&next| !taken[next])).flatten();
                match next {
                    Some(next) => edge = next,
                    None => break,
                }
            }
            lines.push(line);
        }
    }
    lines.sort_by_key(|line| std::cmp::Reverse(line.len()));
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn circles_close_and_lines_end_where_they_fork() {
        let circle = chains(&[[4, 5], [6, 5], [6, 4]]);
        assert_eq!(circle, [[4, 5, 6, 4]]);
        let mut star = chains(&[[0, 1], [0, 2], [2, 3], [4, 0]]);
        star.sort();
        assert_eq!(star, [vec![0, 1], vec![0, 2, 3], vec![4, 0]]);
        assert!(chains(&[]).is_empty());
    }

    #[test]
    fn every_edge_is_in_one_line() {
        // Two circles that share a vertex, and one apart.
        let edges = [[0, 1], [1, 2], [2, 0], [0, 3], [3, 4], [4, 0], [7, 8], [8, 9], [9, 7]];
        let lines = chains(&edges);
        assert_eq!(lines.iter().map(|line| line.len() - 1).sum::<usize>(), edges.len());
        assert!(lines.iter().all(|line| line.first() == line.last()), "{lines:?}");
        assert_eq!(lines.len(), 3);
    }
}
