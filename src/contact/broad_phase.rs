//! Which bodies may meet: a tree of boxes that hold all that each body sweeps in the time ahead.
//!
//! A box tree after those of game engines (Catto's and Presson's dynamic trees): a leaf is put beside the node whose box grows
//! least by it (the surface heuristic of Goldsmith and Salmon 1987), and the way up is balanced by
//! rotations, so that inserting, moving and asking cost O(log n). Half spaces have no box and stay outside.

use crate::math::Vector3;

/// A box along the world's axes.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Aabb {
    /// Its lowest corner [m].
    pub low: Vector3,
    /// Its highest corner [m].
    pub high: Vector3,
}

impl Aabb {
    /// The box of a ball.
    pub fn of_ball(center: &Vector3, radius: f64) -> Self {
        Self { low: center.add_scalar(-radius), high: center.add_scalar(radius) }
    }

    /// The box that holds both.
    #[must_use]
    pub fn joined(&self, other: &Self) -> Self {
        Self { low: self.low.inf(&other.low), high: self.high.sup(&other.high) }
    }

    /// The box with this room [m] on every side.
    #[must_use]
    pub fn grown(&self, by: f64) -> Self {
        Self { low: self.low.add_scalar(-by), high: self.high.add_scalar(by) }
    }

    /// Whether two boxes have a point in common.
    #[inline]
    pub fn meets(&self, other: &Self) -> bool {
        (0..3).all(|i| self.low[i] <= other.high[i] && other.low[i] <= self.high[i])
    }

    /// Half the surface [m²].
    fn surface(&self) -> f64 {
        let d = self.high - self.low;
        d.x * d.y + d.y * d.z + d.z * d.x
    }
}

/// No node.
const NONE: u32 = u32::MAX;

#[derive(Debug, Clone, Copy)]
struct Node {
    aabb: Aabb,
    parent: u32,
    /// Both none in a leaf.
    children: [u32; 2],
    height: u32,
    /// What a leaf holds.
    item: u32,
}

/// A tree of boxes.
#[derive(Debug, Clone)]
pub struct Tree {
    nodes: Vec<Node>,
    root: u32,
    free: Vec<u32>,
    /// The leaf of each item.
    leaves: Vec<u32>,
}

impl Default for Tree {
    fn default() -> Self {
        Self { nodes: Vec::new(), root: NONE, free: Vec::new(), leaves: Vec::new() }
    }
}

impl Tree {
    /// Puts an item's box into the tree, or moves it.
    pub fn put(&mut self, item: usize, aabb: Aabb) {
        self.remove(item);
        if self.leaves.len() <= item {
            self.leaves.resize(item + 1, NONE);
        }
        let leaf = self.node(Node {
            aabb,
            parent: NONE,
            children: [NONE; 2],
            height: 0,
            item: u32::try_from(item).unwrap_or(NONE),
        });
        self.leaves[item] = leaf;
        self.insert(leaf);
    }

    /// Takes an item out of the tree, if it is there.
    pub fn remove(&mut self, item: usize) {
        let Some(&leaf) = self.leaves.get(item).filter(|leaf| **leaf != NONE) else { return };
        self.leaves[item] = NONE;
        self.free.push(leaf);
        let parent = self.nodes[leaf as usize].parent;
        if parent == NONE {
            self.root = NONE;
            return;
        }
        let [a, b] = self.nodes[parent as usize].children;
        let sibling = if a == leaf { b } else { a };
        let above = self.nodes[parent as usize].parent;
        self.free.push(parent);
        self.nodes[sibling as usize].parent = above;
        if above == NONE {
            self.root = sibling;
        } else {
            self.replace(above, parent, sibling);
            self.mend(above);
        }
    }

    /// The box of an item.
    pub fn aabb(&self, item: usize) -> Option<&Aabb> {
        self.leaves.get(item).filter(|leaf| **leaf != NONE).map(|&leaf| &self.nodes[leaf as usize].aabb)
    }

    /// The items whose boxes meet this one, in rising order.
    pub fn meeting(&self, aabb: &Aabb, into: &mut Vec<usize>) {
        into.clear();
        let mut stack = vec![self.root];
        while let Some(at) = stack.pop() {
            if at == NONE {
                continue;
            }
            let node = &self.nodes[at as usize];
            if !node.aabb.meets(aabb) {
                continue;
            }
            if node.height == 0 {
                into.push(node.item as usize);
            } else {
                stack.extend(node.children);
            }
        }
        into.sort_unstable();
    }

    fn node(&mut self, node: Node) -> u32 {
        if let Some(at) = self.free.pop() {
            self.nodes[at as usize] = node;
            return at;
        }
        self.nodes.push(node);
        u32::try_from(self.nodes.len() - 1).unwrap_or(NONE)
    }

    fn replace(&mut self, parent: u32, old: u32, new: u32) {
        for child in &mut self.nodes[parent as usize].children {
            if *child == old {
                *child = new;
            }
        }
    }

    fn insert(&mut self, leaf: u32) {
        if self.root == NONE {
            self.root = leaf;
            return;
        }

        // down to where the surface grows least
        let aabb = self.nodes[leaf as usize].aabb;
        let mut at = self.root;
        while self.nodes[at as usize].height > 0 {
            let node = &self.nodes[at as usize];
            let joined = node.aabb.joined(&aabb).surface();
            let here = 2.0 * joined;
            let inherited = 2.0 * (joined - node.aabb.surface());
            let cost = |child: u32| {
                let child = &self.nodes[child as usize];
                let grown = child.aabb.joined(&aabb).surface();
                inherited + if child.height == 0 { grown } else { grown - child.aabb.surface() }
            };
            let costs = node.children.map(cost);
            if here < costs[0] && here < costs[1] {
                break;
            }
            at = node.children[usize::from(costs[1] < costs[0])];
        }

        // a new node above the two
        let above = self.nodes[at as usize].parent;
        let joined = self.nodes[at as usize].aabb.joined(&aabb);
        let height = self.nodes[at as usize].height + 1;
        let parent = self.node(Node { aabb: joined, parent: above, children: [at, leaf], height, item: NONE });
        self.nodes[at as usize].parent = parent;
        self.nodes[leaf as usize].parent = parent;
        if above == NONE {
            self.root = parent;
        } else {
            self.replace(above, at, parent);
        }
        self.mend(parent);
    }

    /// Makes boxes and heights right from a node up, and balances on the way.
    fn mend(&mut self, from: u32) {
        let mut at = from;
        while at != NONE {
            at = self.balanced(at);
            self.fit(at);
            at = self.nodes[at as usize].parent;
        }
    }

    fn fit(&mut self, at: u32) {
        let [a, b] = self.nodes[at as usize].children;
        let (a, b) = (&self.nodes[a as usize], &self.nodes[b as usize]);
        let (aabb, height) = (a.aabb.joined(&b.aabb), 1 + a.height.max(b.height));
        let node = &mut self.nodes[at as usize];
        (node.aabb, node.height) = (aabb, height);
    }

    /// Lifts the higher child where the two differ by more than one; returns what stands there now.
    fn balanced(&mut self, at: u32) -> u32 {
        let children = self.nodes[at as usize].children;
        let [a, b] = children.map(|c| self.nodes[c as usize].height);
        if a.abs_diff(b) <= 1 {
            return at;
        }
        let high = children[usize::from(b > a)];
        let [c, d] = self.nodes[high as usize].children;
        let (kept, given) =
            if self.nodes[c as usize].height >= self.nodes[d as usize].height { (c, d) } else { (d, c) };

        // `high` takes the place of `at`, which takes over the lower grandchild
        let above = self.nodes[at as usize].parent;
        self.nodes[high as usize].parent = above;
        if above == NONE {
            self.root = high;
        } else {
            self.replace(above, at, high);
        }
        self.nodes[high as usize].children = [kept, at];
        self.nodes[at as usize].parent = high;
        self.replace(at, high, given);
        self.nodes[given as usize].parent = at;
        self.fit(at);
        high
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tree_finds_what_looking_at_all_finds() {
        // boxes that are put, moved and removed; every answer against a look at all
        let mut state = 1u64;
        let mut bits = move || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            state >> 11
        };
        let mut tree = Tree::default();
        let mut boxes: Vec<Option<Aabb>> = vec![None; 300];
        let (mut found, mut total) = (Vec::new(), 0);
        for _ in 0..5000 {
            let item = usize::try_from(bits() % 300).unwrap();
            let mut random = || bits() as f64 / 9007199254740992.0;
            let aabb = Aabb::of_ball(&(10.0 * Vector3::new(random(), random(), random())), random());
            if random() < 0.2 {
                tree.remove(item);
                boxes[item] = None;
            } else {
                tree.put(item, aabb);
                boxes[item] = Some(aabb);
            }
            tree.meeting(&aabb, &mut found);
            let all: Vec<usize> = (0..300).filter(|&i| boxes[i].is_some_and(|b| b.meets(&aabb))).collect();
            assert_eq!(found, all);
            total += all.len();
        }
        assert!(total > 10_000, "{total}");
        // a balanced tree of 300 leaves has 9 levels, an unbalanced one up to 299
        assert!(tree.nodes[tree.root as usize].height <= 18, "{}", tree.nodes[tree.root as usize].height);
    }
}
