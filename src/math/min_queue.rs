//! Priority queues by a number, and shortest paths in graphs with them. Numbers are ordered by [`f64::total_cmp`].

use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// A queue that gives the least cost first; of equal costs the least key.
#[derive(Clone, Debug)]
pub struct MinQueue<K, V = ()> {
    heap: BinaryHeap<Queued<K, V>>,
}

/// An entry of a [`MinQueue`].
#[derive(Clone, Copy, Debug)]
pub struct Queued<K, V = ()> {
    /// The cost; the queue returns the entry of least cost first.
    pub cost: f64,
    /// The key that orders entries of equal cost.
    pub key: K,
    /// The value that comes with the entry.
    pub value: V,
}

impl<K: Ord, V> Default for MinQueue<K, V> {
    fn default() -> Self {
        Self { heap: BinaryHeap::new() }
    }
}

impl<K: Ord, V> MinQueue<K, V> {
    /// Adds to the queue.
    #[inline]
    pub fn push(&mut self, cost: f64, key: K, value: V) {
        self.heap.push(Queued { cost, key, value });
    }

    /// Takes the least out.
    #[inline]
    pub fn pop(&mut self) -> Option<Queued<K, V>> {
        self.heap.pop()
    }

    /// The least cost.
    pub fn least(&self) -> Option<f64> {
        self.heap.peek().map(|least| least.cost)
    }

    /// Takes all out.
    pub fn clear(&mut self) {
        self.heap.clear();
    }
}

impl<K: Ord, V> Extend<Queued<K, V>> for MinQueue<K, V> {
    fn extend<I: IntoIterator<Item = Queued<K, V>>>(&mut self, items: I) {
        self.heap.extend(items);
    }
}

impl<K: Ord, V> FromIterator<Queued<K, V>> for MinQueue<K, V> {
    fn from_iter<I: IntoIterator<Item = Queued<K, V>>>(items: I) -> Self {
        Self { heap: items.into_iter().collect() }
    }
}

impl<K: Ord, V> PartialEq for Queued<K, V> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl<K: Ord, V> Eq for Queued<K, V> {}

/// The greatest, which a heap gives first, has the least cost.
impl<K: Ord, V> Ord for Queued<K, V> {
    #[inline]
    fn cmp(&self, other: &Self) -> Ordering {
        other.cost.total_cmp(&self.cost).then_with(|| other.key.cmp(&self.key))
    }
}

impl<K: Ord, V> PartialOrd for Queued<K, V> {
    #[inline]
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// Lengths of shortest paths from `start` to all of the `nodes` nodes of a graph, infinite where there is none (Dijkstra
/// 1959).
///
/// `links` are the links of a node, each with the node that it leads to and its length, which is not negative. `reached` is called for each
/// node that is reached on a shorter path than before, with the path's last link.
pub fn shortest_paths<L, I: IntoIterator<Item = (u32, f64, L)>>(
    nodes: usize,
    start: u32,
    links: impl Fn(u32) -> I,
    mut reached: impl FnMut(u32, L),
) -> Vec<f64> {
    let mut distance = vec![f64::INFINITY; nodes];
    // Of nodes at equal distances the one with the largest number comes first.
    let mut queue = MinQueue::default();
    distance[start as usize] = 0.0;
    queue.push(0.0, std::cmp::Reverse(start), ());
    while let Some(Queued { cost: here, key: std::cmp::Reverse(node), .. }) = queue.pop() {
        if here > distance[node as usize] {
            continue;
        }
        for (next, length, link) in links(node) {
            let through = here + length;
            if through < distance[next as usize] {
                distance[next as usize] = through;
                reached(next, link);
                queue.push(through, std::cmp::Reverse(next), ());
            }
        }
    }
    distance
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_least_cost_comes_first_and_of_equal_ones_the_least_key() {
        let mut queue = MinQueue::default();
        for (cost, key) in [(2.0, 5), (-1.0, 9), (f64::INFINITY, 0), (2.0, 3), (0.0, 7)] {
            queue.push(cost, key, 10 * key);
        }
        assert_eq!(queue.least(), Some(-1.0));
        let order: Vec<_> = std::iter::from_fn(|| queue.pop()).map(|next| (next.key, next.value)).collect();
        assert_eq!(order, [(9, 90), (7, 70), (3, 30), (5, 50), (0, 0)]);
    }

    #[test]
    fn paths_on_a_grid_are_as_long_as_their_steps() {
        let (width, links) = (7_u32, |node: u32| {
            let [x, y] = [node % 7, node / 7];
            let right = (x < 6).then_some((node + 1, 1.0, node));
            let up = (y < 6).then_some((node + 7, 10.0, node));
            right.into_iter().chain(up)
        });
        let mut before = vec![None; 50];
        // The last node has no link.
        let distance = shortest_paths(50, 0, links, |node, from| before[node as usize] = Some(from));
        for node in 0..width * width {
            assert_eq!(distance[node as usize], f64::from(node % width + 10 * (node / width)));
            assert_eq!(before[node as usize].is_none(), node == 0);
        }
        assert_eq!(distance[49], f64::INFINITY);
    }
}
