//! What is the same for all shapes that are a [`Faceted`](super::Faceted) in a field `solid`?

/// What the trait [`Geometry`](super::Geometry) asks of a shape whose field `solid` is [`Faceted`](super::Faceted).
macro_rules! faceted_geometry {
    () => {
        fn pieces(&self) -> u32 {
            self.solid.count()
        }

        fn nearest_root<N: $crate::exact::Number>(
            &self,
            facet: u32,
            own: &$crate::Ray,
            span: $crate::Span,
            leaving: Option<u32>,
        ) -> $crate::exact::Verdict<Option<$crate::geometry::FacetRoot<N>>> {
            self.solid.nearest_root(facet, own, span, leaving)
        }

        fn crossing(
            &self,
            _: &$crate::Ray,
            at: $crate::exact::Located,
            facet: u32,
        ) -> Option<$crate::Crossing> {
            self.solid.crossing(at, facet)
        }

        fn bounds(&self) -> Option<$crate::Aabb> {
            Some(self.solid.bounds())
        }

        /// Its corners go along; its values stay those of its own space.
        fn placed(&self, placement: &$crate::Placement) -> Self {
            Self { solid: self.solid.placed(placement), ..self.clone() }
        }

        fn parametrization(&self, point: glam::DVec3, facet: u32) -> $crate::geometry::Parametrization {
            self.solid.parametrization(point, facet)
        }

        fn is_closed(&self) -> bool {
            true
        }

        fn is_solid(&self) -> bool {
            true
        }

        fn passage<N: $crate::exact::Number>(
            &self,
            own: &$crate::Ray,
            leaving: Option<u32>,
        ) -> $crate::exact::Verdict<$crate::solid::Passage<N>> {
            if self.solid.is_convex() {
                $crate::solid::convex(self, own, leaving)
            } else {
                self.solid.passage(own, leaving)
            }
        }

        fn faceted(&self) -> Option<&$crate::geometry::Faceted> {
            Some(&self.solid)
        }
    };
}
pub(super) use faceted_geometry;
