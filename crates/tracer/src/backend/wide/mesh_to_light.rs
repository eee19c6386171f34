//! Which ways to a light a mesh blocks: backwards from a lamp all lanes together, towards the sun lane by lane.

use catoptra_core::{Arithmetic, LaneMask, Span};
use fearless_simd::Simd;

use super::Tracer;
use super::mesh::NONE;
use super::packet::Packet;
use super::shadow::Ways;
use super::umpire::Blocked;
use crate::integrator::LIGHT_ITSELF;
use crate::kernel::mesh::{Bundle, Fan, FanRays, Lines, LoneBest, Lones, Umpire, Visits};
use crate::lanes::{D3, F, M, U, pick3, splat_wide, widen3};
use crate::numeric::{END_ERROR, FAN_STEEP, POINT_ERROR, START_ERROR};
use crate::snapshot::Instance;

impl<S: Simd> Tracer<'_, S> {
    /// The ways still open once a mesh stands there. Compiled apart.
    pub(super) fn walk_mesh_to_light(
        &mut self,
        packet: &Packet<'_, S>,
        ways: &Ways<S>,
        open: M<S>,
        instance: &Instance,
    ) -> M<S> {
        self.s.vectorize(
            #[inline(always)]
            || self.walk_mesh_to_light_here(packet, ways, open, instance),
        )
    }

    #[inline(always)]
    fn walk_mesh_to_light_here(
        &mut self,
        packet: &Packet<'_, S>,
        ways: &Ways<S>,
        open: M<S>,
        instance: &Instance,
    ) -> M<S> {
        let Some(mesh) = self.frame.snapshot.mesh_at(instance.prim) else { return open };
        let mut umpire = Blocked { snapshot: self.frame.snapshot, mesh, prim: instance.prim, packet, ways };
        let mut visits = std::mem::take(self.visits);
        let fan =
            if ways.target.at_infinity { None } else { self.fan_to_light((packet, ways), open, instance) };
        let slots = match fan {
            Some((fan, mut rays)) => {
                fan.search(self.s, &instance.tree.tree, &mut visits, &mut rays, &mut umpire);
                self.stats.settled += rays[0].settled;
                rays[0].slot
            }
            None => self.close_each((packet, ways), open, instance, &mut umpire, &mut visits),
        };
        self.count(&mut visits);
        *self.visits = visits;
        open & slots.is(NONE)
    }

    /// The triangles that stand in ways to a light, found one after another.
    #[inline(always)]
    fn close_each(
        &mut self,
        (packet, ways): (&Packet<'_, S>, &Ways<S>),
        open: M<S>,
        instance: &Instance,
        umpire: &mut Blocked<'_, S>,
        visits: &mut Visits,
    ) -> U<S> {
        let (lones, live, span) = if ways.target.at_infinity {
            let (origin, off) = self.own_starts((packet, ways), open, instance);
            let sunwards = umpire.mesh.to_object().vector(ways.target.in_frame);
            let lines = Lines { origin, direction: splat_wide(self.s, sunwards), live: open };
            (Lones::of(self.s, &lines, off, instance.tree.reach), open, Span::AHEAD)
        } else {
            // The starts of ways to one point tell nothing of their directions.
            let lines = Lines::gathered(self.s, open, |lane| umpire.ray(lane).map(|(ray, _)| ray));
            let exact = F::splat(self.s, 0.0);
            (Lones::of(self.s, &lines, exact, instance.tree.reach), lines.live, LIGHT_ITSELF)
        };
        let left = ways.left.facets_of(self.s, instance.prim);
        let begun = LoneBest::nothing_on(span).for_any(true);
        lones.search(self.s, (&instance.tree.tree, visits), (live, left), |_| begun, umpire)
    }

    /// Ways to a light as rays from it, if they run much the same way.
    #[inline(always)]
    fn fan_to_light(
        &self,
        (packet, ways): (&Packet<'_, S>, &Ways<S>),
        open: M<S>,
        instance: &Instance,
    ) -> Option<(Fan, [FanRays<S>; 1])> {
        let apex = instance.own_points(self.s, splat_wide(self.s, ways.target.place));
        let (start, off) = self.own_starts((packet, ways), open, instance);
        let lines = Lines { origin: apex, direction: start - apex, live: open };
        let mut rays = [FanRays::nothing(self.s)];
        let bundle = Bundle::of(self.s, &mut rays, |_| lines, self.reach(instance))?;
        let (scale, zero) = (rays[0].scale, F::splat(self.s, 0.0));
        let error = scale.mul_add(F::splat(self.s, END_ERROR), off);
        let left = ways.left.facets_of(self.s, instance.prim);
        rays[0].start(self.s, [zero, zero], [scale, error], left);
        let steep = rays[0].error_where_off(self.s, off);
        // So close to the lamp that nothing is known of slopes, each goes its own way.
        (steep < 2.0 - FAN_STEEP).then(|| (bundle.fan.for_any().with_slopes_off(steep), rays))
    }

    /// Where ways begin in a mesh's own space, and how far that may be off: settled in `f64` where they leave the mesh
    /// itself.
    #[inline(always)]
    fn own_starts(
        &self,
        (packet, ways): (&Packet<'_, S>, &Ways<S>),
        open: M<S>,
        instance: &Instance,
    ) -> (D3<S>, F<S>) {
        let reach = ways.rays.reach * F::splat(self.s, instance.scale());
        let start = instance.own_points(self.s, widen3(ways.rays.origin));
        let off = reach * F::splat(self.s, POINT_ERROR);
        let own = open & ways.left.prim.is(instance.prim);
        if !own.any() {
            return (start, off);
        }
        let triangles = instance.facets(self.s, ways.left.facet, own);
        let (origin, direction) = self.own_lines(packet, instance);
        let of_lane = |lane: usize| packet.way(lane);
        let t = self.settled_t(instance.prim, (origin, direction), own, &triangles, of_lane);
        let settled = direction.scale_add(t, origin);
        (pick3(own, settled, start), F::pick(own, reach * F::splat(self.s, START_ERROR), off))
    }
}
