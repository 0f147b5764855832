//! What must hold for every chain against planes.

use crate::support::about_z;
use centrode_core::model::chain::free::{by_theta_l_and_delta, point};
use centrode_core::model::chain::{Contact, Rod, Settled, Torsion, free, settle};
use centrode_core::model::contact::plane;
use centrode_core::model::contact::ritz::Basis;
use centrode_core::model::contact::{Meeting, Planar};
use centrode_core::model::{Configuration, Mat3, Pose, Twist, Vec3};
use proptest::prelude::*;
use std::f64::consts::PI;

/// A chain, how it is bent, and planes pressed into the shape that it would have if it were free.
#[derive(Debug, Clone)]
struct Case {
    rods: Vec<Rod>,
    at: Vec<Configuration>,
    contacts: Vec<Contact>,
}

impl Case {
    fn lengths(&self) -> Vec<f64> {
        self.rods.iter().map(|rod| rod.length).collect()
    }

    fn settle(&self) -> Option<Settled> {
        settle(&self.rods, &self.at, &self.contacts).ok()
    }

    /// With θL or δ of one segment changed.
    fn moved(&self, column: usize, step: f64) -> Option<Settled> {
        let mut moved = self.clone();
        let at = &mut moved.at[column / 2];
        *at = if column.is_multiple_of(2) {
            Configuration::new(at.bend() - step, at.delta())
        } else {
            Configuration::new(at.bend(), at.delta() + step)
        };
        moved.settle()
    }
}

fn torsion() -> impl Strategy<Value = Torsion> {
    prop_oneof![Just(Torsion::Rigid), (0.7..20.0f64).prop_map(Torsion::Ratio)]
}

fn segment() -> impl Strategy<Value = (Rod, Configuration)> {
    (0.02..0.035f64, 0.8..4.0f64, torsion(), 0.1..1.2f64, -PI..PI).prop_map(
        |(length, stiffness, torsion, bend, delta)| {
            (Rod { length, bending_stiffness: stiffness * 1e-3, torsion }, Configuration::new(bend, delta))
        },
    )
}

/// A place along the chain (1 is the tip), a direction, and how deep the plane stands in the free shape, over the chain's length.
fn pressed() -> impl Strategy<Value = (f64, [f64; 3], f64)> {
    (0.1..1.0f64, prop::array::uniform3(-1.0..1.0f64), 0.0..0.08f64)
}

fn case(segments: std::ops::RangeInclusive<usize>) -> impl Strategy<Value = Case> {
    let segments = prop::collection::vec(segment(), segments);
    (segments, prop::collection::vec(pressed(), 1..=3)).prop_map(|(segments, planes)| {
        let (rods, at): (Vec<Rod>, Vec<Configuration>) = segments.into_iter().unzip();
        let lengths: Vec<f64> = rods.iter().map(|rod| rod.length).collect();
        let whole: f64 = lengths.iter().sum();
        let contact = |(share, direction, depth): (f64, [f64; 3], f64)| {
            let place = share * lengths.len() as f64;
            let segment = (place as usize).min(lengths.len() - 1);
            let at_length = (place - segment as f64).clamp(0.1, 1.0) * lengths[segment];
            let free = point(&lengths, &at, segment, at_length);
            // Across the backbone: along it, nothing could yield.
            let along: Vec3 = free.rotation.column(2).into();
            let direction = Vec3::from(direction) + Vec3::new(0.01, 0.0, 0.0);
            let normal = (direction - along * (0.8 * direction.dot(&along))).normalize();
            let offset = normal.dot(&free.position) - depth * share * whole;
            Contact { segment, at: at_length, normal, offset }
        };
        Case { contacts: planes.into_iter().map(contact).collect(), rods, at }
    })
}

fn distance(a: &Pose, b: &Pose) -> f64 {
    (a.position - b.position).amax().max((a.rotation - b.rotation).amax() * 0.1)
}

/// Angular velocity of a rotation that changes from `a` to `b`.
fn turn(a: &Mat3, b: &Mat3) -> Vec3 {
    let change = b * a.transpose();
    let skew = (change - change.transpose()) * 0.5;
    Vec3::new(skew[(2, 1)], skew[(0, 2)], skew[(1, 0)])
}

/// Planes that no chain can stand against, or between sets of contacts: another case is tried.
fn unsettled() -> Result<(), TestCaseError> {
    Err(TestCaseError::reject("no stable shape"))
}

/// Away from where a branch ends every quantity is smooth enough to be differenced.
const FIRM: f64 = 0.1;

proptest! {
    #![proptest_config(ProptestConfig { cases: 32, ..ProptestConfig::default() })]

    #[test]
    fn planes_push_where_they_touch_and_nothing_passes_them(case in case(1..=4)) {
        let Some(settled) = case.settle() else { return unsettled() };
        prop_assert!(settled.margin > 0.0 && settled.margin <= 1.0);
        for (place, (force, gap)) in settled.forces.iter().zip(&settled.gaps).enumerate() {
            prop_assert!(*force >= 0.0 && *gap >= -1e-13, "{force} {gap}");
            prop_assert_eq!(*force * *gap, 0.0);
            prop_assert_eq!(settled.active.contains(&place), *force > 0.0 || *gap == 0.0);
        }
        let unloaded = free(&case.lengths(), &case.at);
        let last = settled.active.iter().map(|place| case.contacts[*place].segment).max();
        for (segment, disk) in settled.disks.iter().enumerate() {
            prop_assert!((disk.pose.rotation * disk.pose.rotation.transpose() - Mat3::identity()).amax() < 1e-14);
            // Above the last contact every segment keeps its own shape.
            if segment > 0 && last.is_none_or(|last| segment > last) {
                let relative = |disks: &[centrode_core::model::chain::Disk]| {
                    let [a, b] = [&disks[segment - 1].pose, &disks[segment].pose];
                    Pose { position: a.rotation.transpose() * (b.position - a.position), rotation: a.rotation.transpose() * b.rotation }
                };
                prop_assert!(distance(&relative(&settled.disks), &relative(&unloaded)) < 1e-14);
            }
        }
    }

    #[test]
    fn turning_the_base_turns_everything(case in case(1..=3), angle in -PI..PI) {
        let base = about_z(-angle);
        let mut turned = case.clone();
        turned.at.iter_mut().for_each(|at| *at = Configuration::new(at.bend(), at.delta() + angle));
        turned.contacts.iter_mut().for_each(|contact| contact.normal = base * contact.normal);
        let (Some(a), Some(b)) = (case.settle(), turned.settle()) else { return unsettled() };
        prop_assert_eq!(&a.active, &b.active);
        prop_assert!((a.margin - b.margin).abs() < 1e-9);
        for (a, b) in a.disks.iter().zip(&b.disks) {
            let expected = Pose { position: base * a.pose.position, rotation: base * a.pose.rotation * base.transpose() };
            prop_assert!(distance(&expected, &b.pose) < 1e-11);
        }
        for (a, b) in a.forces.iter().zip(&b.forces) {
            prop_assert!((a - b).abs() < 1e-8 * a.max(1.0));
        }
    }

    #[test]
    fn mirroring_mirrors_everything(case in case(1..=3)) {
        let mirror = Mat3::from_diagonal(&Vec3::new(1.0, -1.0, 1.0));
        let mut mirrored = case.clone();
        mirrored.at.iter_mut().for_each(|at| *at = Configuration::new(at.bend(), -at.delta()));
        mirrored.contacts.iter_mut().for_each(|contact| contact.normal = mirror * contact.normal);
        let (Some(a), Some(b)) = (case.settle(), mirrored.settle()) else { return unsettled() };
        prop_assert_eq!(&a.active, &b.active);
        prop_assert!((a.margin - b.margin).abs() < 1e-9);
        for (a, b) in a.disks.iter().zip(&b.disks) {
            let expected = Pose { position: mirror * a.pose.position, rotation: mirror * a.pose.rotation * mirror };
            prop_assert!(distance(&expected, &b.pose) < 1e-11);
        }
    }

    #[test]
    fn twists_moments_and_force_slopes_are_derivatives(case in case(1..=3), column in 0..6usize) {
        let (column, step) = (column % (2 * case.rods.len()), 1e-5);
        let Some(settled) = case.settle().filter(|settled| settled.margin > FIRM) else { return unsettled() };
        let (Some(a), Some(b)) = (case.moved(column, -step), case.moved(column, step)) else { return unsettled() };
        // Between two sets of contacts nothing is smooth.
        prop_assume!(a.active == settled.active && b.active == settled.active);
        for ((disk, a), b) in settled.disks.iter().zip(&a.disks).zip(&b.disks) {
            let Twist { linear, angular } = disk.by_configuration(&case.at)[column / 2][column % 2];
            let moved = (b.pose.position - a.pose.position) / (2.0 * step);
            prop_assert!((moved - linear).amax() < 1e-7, "{moved} {linear}");
            let turned = turn(&a.pose.rotation, &b.pose.rotation) / (2.0 * step);
            prop_assert!((turned - angular).amax() < 1e-5, "{turned} {angular}");
        }
        let at = case.at[column / 2];
        let pair = |bends: centrode_core::model::chain::Bends| by_theta_l_and_delta(at, [bends.x, bends.y])[column % 2];
        let (stiffness, length) = (4e-3, 0.02);
        let slope = (b.energy - a.energy) / (2.0 * step);
        let scale = stiffness / length + settled.forces.iter().sum::<f64>() * length;
        prop_assert!((slope - pair(settled.moments[column / 2])).abs() < 1e-7 * scale);
        for place in 0..case.contacts.len() {
            let slope = (b.forces[place] - a.forces[place]) / (2.0 * step);
            prop_assert!((slope - pair(settled.forces_by_bends[place][column / 2])).abs() < 1e-5 * scale / length);
        }
    }

    /// What the planes do is their force along their way: F = −∂E*/∂d.
    #[test]
    fn forces_are_what_it_costs_to_press_a_plane_in(case in case(1..=3)) {
        let Some(settled) = case.settle().filter(|settled| settled.margin > FIRM) else { return unsettled() };
        let step = 1e-7;
        for place in settled.active.clone() {
            let pressed = |step: f64| {
                let mut case = case.clone();
                case.contacts[place].offset += step;
                case.settle()
            };
            let (Some(a), Some(b)) = (pressed(-step), pressed(step)) else { continue };
            if a.active == settled.active && b.active == settled.active {
                let slope = (a.energy - b.energy) / (2.0 * step);
                prop_assert!((slope - settled.forces[place]).abs() < 1e-5 * (1.0 + settled.forces[place]), "{slope} {}", settled.forces[place]);
            }
        }
    }

    /// From the segment with the last contact on, a chain is one segment on a moving base.
    #[test]
    fn the_segment_of_the_last_contact_is_one_on_a_moving_base(case in case(2..=4)) {
        let Some(settled) = case.settle() else { return unsettled() };
        let Some(last) = settled.active.iter().map(|place| case.contacts[*place].segment).max() else { return unsettled() };
        prop_assume!(last > 0);
        let base = settled.disks[last - 1].pose;
        let seen = |contact: &Contact| Contact {
            segment: 0,
            normal: base.rotation.transpose() * contact.normal,
            offset: contact.offset - contact.normal.dot(&base.position),
            ..*contact
        };
        let places: Vec<usize> = (0..case.contacts.len()).filter(|place| case.contacts[*place].segment == last).collect();
        let alone: Vec<Contact> = places.iter().map(|place| seen(&case.contacts[*place])).collect();
        let Ok(one) = settle(&case.rods[last..=last], &case.at[last..=last], &alone) else { return unsettled() };
        // Of several stable shapes the chain and the segment alone may come to different ones.
        prop_assume!((one.forces.iter().sum::<f64>() - places.iter().map(|place| settled.forces[*place]).sum::<f64>()).abs() < 1e-3);
        for (force, place) in one.forces.iter().zip(places) {
            prop_assert!((force - settled.forces[place]).abs() < 1e-8 * (1.0 + force));
        }
        let tip = &one.disks[0].pose;
        let carried = Pose { position: base.position + base.rotation * tip.position, rotation: base.rotation * tip.rotation };
        prop_assert!(distance(&carried, &settled.disks[last].pose) < 1e-11);
    }

    #[test]
    fn a_very_stiff_torsion_is_a_rigid_one(mut case in case(2..=3)) {
        case.rods.iter_mut().for_each(|rod| rod.torsion = Torsion::Rigid);
        let rigid = case.settle();
        case.rods.iter_mut().for_each(|rod| rod.torsion = Torsion::Ratio(1e6));
        let (Some(rigid), Some(stiff)) = (rigid, case.settle()) else { return unsettled() };
        prop_assume!(rigid.margin > FIRM && stiff.margin > FIRM);
        for (a, b) in rigid.disks.iter().zip(&stiff.disks) {
            prop_assert!(distance(&a.pose, &b.pose) < 1e-6);
        }
    }

    /// One segment in its plane is what `model::contact` makes of it.
    #[test]
    fn one_segment_in_its_plane_agrees_with_the_planar_contact(
        place in 0.1..0.9f64, met in 0.05..1.2f64, more in 0.01..0.8f64, delta in -PI..PI, torsion in torsion(),
    ) {
        let (length, stiffness) = (0.03, 2.0e-3);
        let meeting = Meeting { place, bend: met, side: 1.0 };
        let at = Configuration::new(met + more, delta);
        let toward = Vec3::new(delta.cos(), -delta.sin(), 0.0);
        let lift = |p: Planar| toward * p.x + Vec3::z() * p.y;
        let free = point(&[length], &[Configuration::new(met, delta)], 0, place * length);
        let normal: Vec3 = lift(Planar::new(meeting.slope().cos(), -meeting.slope().sin()));
        let contact = Contact { segment: 0, at: place * length, normal, offset: normal.dot(&free.position) };
        let ours = settle(&[Rod { length, bending_stiffness: stiffness, torsion }], &[at], &[contact]).expect("stable");
        let basis = Basis::new();
        let planar = plane::solve(&basis, &meeting, met + more, None).expect("a shape").touching;
        let (tip, by) = planar.tip(&basis);
        let force = planar.force() * stiffness / (length * length);
        prop_assert!((ours.forces[0] - force).abs() < 1e-11 * force, "{} {force}", ours.forces[0]);
        prop_assert!((ours.disks[0].pose.position - lift(tip) * length).amax() < 1e-14);
        let moved = ours.disks[0].by_configuration(&[at])[0][0];
        prop_assert!((moved.linear + lift(by) * length).amax() < 1e-12);
        let moment = ours.moments[0].norm() * length / stiffness;
        prop_assert!((moment - planar.curvature_above()).abs() < 1e-11 * moment);
    }
}

/// A plane that leans out of the bending plane takes even one segment with it, and the segment's end disk turns about its tangent.
#[test]
fn an_oblique_plane_takes_one_segment_out_of_its_plane() {
    let rod = |torsion| [Rod { length: 0.03, bending_stiffness: 2e-3, torsion }];
    let at = [Configuration::new(1.0, 0.0)];
    let middle = point(&[0.03], &at, 0, 0.02).position;
    for tilt in [0.3f64, -0.3] {
        let normal = Vec3::new(tilt.cos(), tilt.sin(), 0.0);
        let contact = Contact { segment: 0, at: 0.02, normal, offset: normal.dot(&middle) - 1e-3 };
        let settled = settle(&rod(Torsion::Ratio(5.0)), &at, &[contact]).expect("stable");
        let rigid = settle(&rod(Torsion::Rigid), &at, &[contact]).expect("stable");
        let aside = |settled: &Settled| settled.disks[0].pose.position.y;
        assert!(aside(&settled) * tilt < -1e-6 && aside(&rigid) * tilt < -1e-6);
        assert!((aside(&settled) - aside(&rigid)).abs() > 1e-7, "torsion counts");
    }
}

/// In the bending plane a contact on the third segment holds up to a bend, and not beyond: no shape is answered there.
#[test]
fn a_chain_that_buckles_gets_no_answer() {
    let rods: Vec<Rod> = [3.0, 2.0, 1.0]
        .map(|stiffness| Rod { length: 0.03, bending_stiffness: stiffness, torsion: Torsion::Rigid })
        .into();
    let lengths = [0.03; 3];
    let bent = |degrees: f64| [Configuration::new(degrees.to_radians(), 0.0); 3];
    let answer = |segment: usize, degrees: f64| {
        let met = point(&lengths, &bent(20.0), segment, 0.015);
        let normal: Vec3 = met.rotation.column(0).into();
        let contact = Contact { segment, at: 0.015, normal, offset: normal.dot(&met.position) };
        settle(&rods, &bent(degrees), &[contact])
    };
    for (segment, holds, buckles) in [(2, 45.0, 47.0), (1, 63.0, 66.0)] {
        let mut before = 1.0;
        for degrees in [20.5, 30.0, 40.0, holds] {
            let margin = answer(segment, degrees).expect("stable").margin;
            assert!(margin < before, "{margin} after {before}");
            before = margin;
        }
        let refused = answer(segment, buckles).expect_err("unstable");
        assert!((refused.reached - holds / buckles).abs() < 0.06, "{refused}");
        assert!(refused.margin.is_some_and(|margin| margin < 0.0), "{refused}");
        assert!(refused.to_string().contains("buckles at"), "{refused}");
    }
    assert!(answer(0, 90.0).expect("stable").margin > 0.9);
}

/// Where planes ask for what no chain can do there is no answer, and no panic.
#[test]
fn planes_out_of_reach_get_no_answer() {
    let rod = Rod { length: 0.03, bending_stiffness: 1.0, torsion: Torsion::Ratio(5.0) };
    let at = [Configuration::new(0.5, 0.0); 2];
    let contact = |normal: Vec3, offset| Contact { segment: 1, at: 0.03, normal, offset };
    let far = contact(Vec3::x(), -0.2);
    assert!(settle(&[rod; 2], &at, &[far]).is_err());
    let between = [contact(Vec3::x(), 0.004), contact(-Vec3::x(), -0.005)];
    assert!(settle(&[rod; 2], &at, &between).is_err());
}
