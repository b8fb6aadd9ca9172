//! Disjoint sets of numbers (union and find).
//!
//! Which number stands for a set is part of some results, in whose order they come: [`DisjointSets::join`] says which it is. Crates for
//! this join by rank or size, and leave it open.

/// A partition of 0..n into sets that are joined two by two.
#[derive(Clone, Debug)]
pub struct DisjointSets {
    parent: Vec<u32>,
}

impl DisjointSets {
    /// n sets of one number each.
    pub fn new(n: usize) -> Self {
        Self { parent: (0..n as u32).collect() }
    }

    /// The number that stands for the set of i, until that is joined with another.
    pub fn root(&mut self, mut i: usize) -> usize {
        while self.parent[i] as usize != i {
            self.parent[i] = self.parent[self.parent[i] as usize];
            i = self.parent[i] as usize;
        }
        i
    }

    /// Joins two sets, for which the number that stood for that of j stands from now on; `false` when they were one already.
    pub fn join(&mut self, i: usize, j: usize) -> bool {
        let (a, b) = (self.root(i), self.root(j));
        self.parent[a] = b as u32;
        a != b
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn joined_numbers_have_one_root() {
        let mut sets = DisjointSets::new(9);
        assert!((0..6).all(|i| sets.join(i, i + 3)));
        assert!(!sets.join(0, 6));
        assert!((0..9).all(|i| (0..9).all(|j| (sets.root(i) == sets.root(j)) == (i % 3 == j % 3))));
    }
}
