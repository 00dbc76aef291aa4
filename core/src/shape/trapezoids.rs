//! A polygon of any outline, cut into trapezoids without memory.
//!
//! Lines of equal height go through all vertices, and through all places where edges cross. Between two
//! neighboring lines no edge begins, ends or crosses another: there, what lies inside the outline is between
//! the first and the second edge, the third and the fourth, and so on (even-odd rule).

use crate::math::{Real, Vec3};

/// A place in the plane: along the lines of equal height, and the height.
type Place<S> = (S, S);

/// An edge that is not level, from its lower end to its upper end.
#[derive(Clone, Copy)]
struct Edge<S> {
    low: Place<S>,
    high: Place<S>,
}

impl<S: Real> Edge<S> {
    /// The edge between two vertices; `None` if it is level.
    fn between(a: Place<S>, b: Place<S>) -> Option<Self> {
        if a.1 < b.1 {
            Some(Self { low: a, high: b })
        } else if b.1 < a.1 {
            Some(Self { low: b, high: a })
        } else {
            None
        }
    }

    /// Where the edge passes a height. At both ends this is the vertex itself.
    fn at(&self, height: S) -> S {
        let ((from, bottom), (to, top)) = (self.low, self.high);
        if height >= top { to } else { from + (to - from) * ((height - bottom) / (top - bottom)) }
    }

    /// Whether the edge goes all the way from one height to another.
    fn spans(&self, bottom: S, top: S) -> bool {
        self.low.1 <= bottom && self.high.1 >= top
    }

    /// The height at which two edges cross, if they do.
    fn crossing(&self, other: &Self) -> Option<S> {
        let (bottom, top) = (self.low.1.larger(other.low.1), self.high.1.smaller(other.high.1));
        let (below, above) = (self.at(bottom) - other.at(bottom), self.at(top) - other.at(top));
        let crosses = below < S::ZERO && above > S::ZERO || below > S::ZERO && above < S::ZERO;
        crosses.then(|| bottom + (top - bottom) * (below / (below - above)))
    }
}

/// The outline of a polygon: the first two coordinates of each vertex.
struct Outline<'o, R>(&'o [Vec3<R>]);

impl<R: Real> Outline<'_, R> {
    fn places(&self) -> impl Iterator<Item = Place<R::Setup>> {
        self.0.iter().map(|vertex| (vertex.x.to_setup(), vertex.y.to_setup()))
    }

    fn edges(&self) -> impl Iterator<Item = Edge<R::Setup>> {
        let next = self.places().skip(1).chain(self.places().take(1));
        self.places().zip(next).filter_map(|(from, to)| Edge::between(from, to))
    }

    /// The next height at which an edge begins, ends or crosses another.
    fn next_height(&self, bottom: R::Setup) -> Option<R::Setup> {
        let above = self.places().map(|(_, height)| height).filter(|height| *height > bottom);
        let vertex = above.reduce(Real::smaller)?;
        let mut top = vertex;
        for (number, edge) in self.edges().enumerate().filter(|(_, edge)| edge.spans(bottom, vertex)) {
            for other in self.edges().skip(number).filter(|other| other.spans(bottom, vertex)) {
                // A crossing that is rounded onto a line is no new one.
                if let Some(height) = edge.crossing(&other)
                    && height > bottom
                    && height < top
                {
                    top = height;
                }
            }
        }
        Some(top)
    }

    /// The next edge to the right of another one, which is given by its number and its place in the middle
    /// between the heights. Without another one, the edge on the very left.
    fn next_edge(
        &self,
        last: Option<(R::Setup, usize)>,
        bottom: R::Setup,
        top: R::Setup,
    ) -> Option<(R::Setup, usize, Edge<R::Setup>)> {
        let middle = (bottom + top) * R::Setup::from_f32(0.5);
        let edges = self.edges().enumerate().filter(|(_, edge)| edge.spans(bottom, top));
        let places = edges.map(|(number, edge)| (edge.at(middle), number, edge));
        let is_left = |a: (R::Setup, usize), b: (R::Setup, usize)| a.0 < b.0 || a.0 == b.0 && a.1 < b.1;
        places
            .filter(|(place, number, _)| last.is_none_or(|last| is_left(last, (*place, *number))))
            .reduce(|a, b| if is_left((b.0, b.1), (a.0, a.1)) { b } else { a })
    }
}

/// Calls `visit` with the corners of each trapezoid, counterclockwise from the lower left one. Two corners
/// of a triangle coincide. `outline` has the two coordinates of each vertex first.
pub(super) fn each_trapezoid<R: Real>(outline: &[Vec3<R>], mut visit: impl FnMut([Place<R::Setup>; 4])) {
    let outline = Outline(outline);
    let Some(mut bottom) = outline.places().map(|(_, height)| height).reduce(Real::smaller) else { return };
    // Heights grow, and there are finitely many vertices and crossings.
    while let Some(top) = outline.next_height(bottom) {
        let mut last = None;
        while let Some((place, number, left)) = outline.next_edge(last, bottom, top)
            && let Some((next_place, next_number, right)) =
                outline.next_edge(Some((place, number)), bottom, top)
        {
            visit([
                (left.at(bottom), bottom),
                (right.at(bottom), bottom),
                (right.at(top), top),
                (left.at(top), top),
            ]);
            last = Some((next_place, next_number));
        }
        bottom = top;
    }
}
