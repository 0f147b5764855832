//! From event to event.

use super::clamp::Holding;
use super::fit::{Fit, Node, STEPS, Solved, from_free, points};
use super::{Course, Happened, Path, Plane, Stands, Stretch, What};
use crate::model::chain::modes::{Layout, Units};
use crate::model::chain::newton::{Held, Near, Unknowns, nearby};
use crate::model::chain::profile::Profile;
use crate::model::chain::search::{LEAST_MARGIN, search};
use crate::model::chain::stability::{is_stable, margin};
use crate::model::chain::{Bends, Contact, Rod, Unsettled, configuration, free};
use crate::model::{Pose, Vec3};
use nalgebra::DVector;
use std::sync::Arc;

/// A stretch shorter than this share of the whole time is none.
const SHORTEST: f64 = 1e-9;
/// Where the chain buckles, the path ends this share of the whole time before, or ten times as much.
const BACK: f64 = 1e-9;
/// A force below −this (EI/L²) pulls, a gap below −that (of the length) is passed.
const PULLS: f64 = 1e-8;
const PASSED: f64 = 1e-11;
/// Highest Legendre terms, tried in turn.
const TERMS: [usize; 7] = [6, 8, 10, 13, 17, 22, 30];
/// The highest of them may bend a piece by so much, rad. What the tip has of it is less than a thousandth.
const TAIL: f64 = 1e-5;
/// A margin below this is looked at closely.
const DOUBTFUL: f64 = 0.1;
/// Looks for a sign between two nodes.
const LOOKS: usize = 8;
/// So many events at one instant are too many to be followed.
const STUCK: usize = 8;

/// The backbone cut at the planes that stand, and the shape at the instant that is reached.
#[derive(Clone)]
struct Cut {
    layout: Arc<Layout>,
    /// Planes that stand, in the layout's order, and their normals and offsets in its units.
    standing: Vec<usize>,
    planes: Vec<Held>,
}

struct Follower<'a> {
    rods: &'a [Rod],
    course: &'a dyn Course,
    listed: &'a [Plane],
    units: Units,
    /// The largest bends of the whole course, which say how fine the backbone is cut.
    largest: Vec<Bends>,
    whole: f64,
    path: Path,
    /// The shape at the instant reached.
    profile: Profile,
    active: Vec<usize>,
    forces: Vec<f64>,
    /// How many terms were needed so far, by their place in [`TERMS`].
    terms: usize,
}

/// Why a stretch was not solved as it was asked for.
enum Short {
    /// It is stable up to here at least, and not at the next time.
    Buckles(f64, f64),
    /// Nothing was found, or the nodes are too few.
    Rough,
    /// More terms are needed.
    Coarse,
}

pub(super) fn follow(rods: &[Rod], course: &dyn Course, knots: &[f64], listed: &[Plane]) -> Result<Path, Unsettled> {
    let (first, last) = (knots.first().copied().unwrap_or(0.0), knots.last().copied().unwrap_or(0.0));
    let looks = knots.windows(2).flat_map(|pair| (0..=32).map(|k| pair[0] + (pair[1] - pair[0]) * f64::from(k) / 32.0));
    let mut largest = vec![Bends::zeros(); rods.len()];
    for time in looks {
        for (most, bends) in largest.iter_mut().zip(course.bends(time)) {
            if bends.norm() > most.norm() {
                *most = bends;
            }
        }
    }
    let path = Path {
        rods: rods.to_vec(),
        clamp: None,
        stretches: Vec::new(),
        happened: Vec::new(),
        planes: listed
            .iter()
            .map(|plane| match plane.stands {
                Stands::Always { normal, offset } => Some((normal, offset)),
                Stands::From { .. } | Stands::Clamped { .. } => None,
            })
            .collect(),
        end: first,
    };
    let mut follower = Follower {
        rods,
        course,
        listed,
        units: Units::of(rods),
        largest,
        whole: last - first,
        path,
        profile: Profile::free(rods, &course.bends(first)),
        active: Vec::new(),
        forces: vec![0.0; listed.len()],
        terms: 0,
    };
    follower.begin(first)?;
    let mut stops: Vec<f64> = knots.iter().copied().chain(listed.iter().filter_map(Plane::time)).collect();
    stops.retain(|time| *time > first && *time <= last);
    stops.sort_by(f64::total_cmp);
    stops.dedup();
    stops.insert(0, first);
    for stop in stops {
        if !follower.until(stop) {
            break;
        }
        let clamp = listed.iter().position(|plane| plane.is_clamp() && plane.time() == Some(stop));
        if let Some(contact) = clamp {
            return follower.clamped(contact, stop, knots);
        }
        follower.place(stop);
    }
    Ok(follower.path)
}

impl Follower<'_> {
    /// From a clamp on, what is above it goes its own way.
    fn clamped(mut self, contact: usize, time: f64, knots: &[f64]) -> Result<Path, Unsettled> {
        self.path.happened.push(Happened { time, what: What::Met(contact) });
        let instant = self.path.unclamped(time, &self.course.bends(time));
        let (rods, course, planes, shape) = (self.rods, self.course, self.listed, self.profile);
        let clamp = Holding { time, contact, rods, course, knots, planes, shape, instant }.follow()?;
        let mut path = self.path;
        // What pressed above it goes on, and is no news.
        let pressing = |event: &Happened| !matches!(event.what, What::Met(place) if event.time == time && self.active.contains(&place));
        path.happened.extend(clamp.happened().filter(pressing));
        for (place, stands) in clamp.planes() {
            path.planes[place] = Some(stands);
        }
        path.end = clamp.end();
        path.clamp = Some(Box::new(clamp));
        Ok(path)
    }

    /// What presses as the chain begins.
    fn begin(&mut self, first: f64) -> Result<(), Unsettled> {
        let bends = self.course.bends(first);
        let contacts = self.contacts(&self.standing());
        let at: Vec<_> = bends.iter().map(configuration).collect();
        let lengths: Vec<f64> = self.rods.iter().map(|rod| rod.length).collect();
        let passed = contacts.iter().any(|contact| {
            let point = free::point(&lengths, &at, contact.segment, contact.at).position;
            contact.offset - contact.normal.dot(&point) < -PASSED * self.units.length
        });
        if !passed {
            return Ok(());
        }
        let found = search(self.rods, &at, &contacts)?;
        self.profile = Profile::of(&found.layout, self.rods, &found.equilibrium.at.x, &bends);
        let standing = self.standing();
        for (row, &place) in found.active.iter().enumerate() {
            self.forces[standing[place]] = found.equilibrium.at.forces[row];
            self.met(first, standing[place]);
        }
        Ok(())
    }

    fn standing(&self) -> Vec<usize> {
        (0..self.listed.len()).filter(|&place| self.path.planes[place].is_some()).collect()
    }

    fn contacts(&self, standing: &[usize]) -> Vec<Contact> {
        let contact = |&place: &usize| {
            let (normal, offset) = self.path.planes[place]?;
            Some(Contact { segment: self.listed[place].segment, at: self.listed[place].at, normal, offset })
        };
        standing.iter().filter_map(contact).collect()
    }

    fn met(&mut self, time: f64, contact: usize) {
        let row = self.active.partition_point(|&other| other < contact);
        self.active.insert(row, contact);
        self.path.happened.push(Happened { time, what: What::Met(contact) });
    }

    fn cut(&self, terms: usize) -> Cut {
        let standing = self.standing();
        let contacts = self.contacts(&standing);
        let layout = Layout::new(self.rods, &self.largest, &contacts, terms);
        let held = |(contact, piece): (&Contact, &usize)| Held {
            piece: *piece,
            normal: contact.normal,
            offset: contact.offset / self.units.length,
        };
        let planes = contacts.iter().zip(&layout.contacts).map(held).collect();
        Cut { layout: Arc::new(layout), standing, planes }
    }

    /// Planes that come to stand now, where the chain is now.
    fn place(&mut self, now: f64) {
        for (place, plane) in self.listed.iter().enumerate().filter(|(_, plane)| plane.time() == Some(now)) {
            // A chain that rests is asked where it goes next.
            let (point, velocity) = [1e-6, 1e-3, 1.0].into_iter().fold((None, Vec3::zeros()), |found, share| {
                if found.1.norm() > 0.0 { found } else { self.point(place, now, share * self.whole) }
            });
            let Some(point) = point else { continue };
            self.path.planes[place] = plane.placed(&point, &velocity);
            let presses = self.path.planes[place].is_some_and(|(normal, _)| normal.dot(&velocity) > 0.0);
            if presses {
                self.forces[place] = 0.0;
                self.met(now, place);
            }
        }
    }

    /// A listed point now, and where it goes within a while.
    fn point(&self, place: usize, now: f64, while_: f64) -> (Option<Pose>, Vec3) {
        let Plane { segment, at, .. } = self.listed[place];
        let here = self.profile.pose(self.rods, segment, at);
        let bends = self.course.bends(now + while_);
        let ahead = if self.active.is_empty() {
            Profile::free(self.rods, &bends)
        } else {
            let cut = self.cut(TERMS[0]);
            let start = self.start(&cut);
            match self.node(&cut, now + while_, start) {
                Some((node, _)) => Profile::of(&cut.layout, self.rods, &node.at.x, &bends),
                None => Profile::free(self.rods, &bends),
            }
        };
        (Some(here), ahead.pose(self.rods, segment, at).position - here.position)
    }

    /// The shape reached, in the terms of a cut.
    fn start(&self, cut: &Cut) -> Unknowns {
        let forces = self.active.iter().map(|&place| self.forces[place]);
        Unknowns {
            x: self.profile.factors(&cut.layout, self.rods),
            forces: DVector::from_iterator(self.active.len(), forces),
        }
    }

    /// From where it is to a time; whether it came there.
    fn until(&mut self, stop: f64) -> bool {
        let mut stuck = 0;
        while self.path.end < stop {
            let before = self.path.end;
            let went = if self.active.is_empty() { self.freely(stop) } else { self.pressed(stop) };
            if !went {
                return false;
            }
            stuck = if self.path.end - before > SHORTEST * self.whole { 0 } else { stuck + 1 };
            if stuck > STUCK {
                self.path.happened.push(Happened { time: self.path.end, what: What::Lost });
                return false;
            }
        }
        true
    }

    fn push(&mut self, to: f64, fit: Fit) {
        let from = std::mem::replace(&mut self.path.end, to);
        self.path.stretches.push(Stretch { from, to, active: self.active.clone(), fit });
    }

    /// Nothing presses: until a plane is met.
    fn freely(&mut self, stop: f64) -> bool {
        let (from, standing) = (self.path.end, self.standing());
        let contacts = self.contacts(&standing);
        let lengths: Vec<f64> = self.rods.iter().map(|rod| rod.length).collect();
        let gap = |contact: &Contact, time: f64| {
            let at: Vec<_> = self.course.bends(time).iter().map(configuration).collect();
            let point = free::point(&lengths, &at, contact.segment, contact.at).position;
            (contact.offset - contact.normal.dot(&point)) / self.units.length
        };
        let mut first: Option<(f64, usize)> = None;
        for (contact, &place) in contacts.iter().zip(&standing) {
            let times = (1..=64).map(|k| from + (stop - from) * f64::from(k) / 64.0);
            if let Some(time) = crossing(from, times, |time| gap(contact, time) + PASSED)
                && first.is_none_or(|(other, _)| time < other)
            {
                first = Some((time, place));
            }
        }
        let to = first.map_or(stop, |(time, _)| time);
        self.push(to, Fit::Free);
        self.profile = Profile::free(self.rods, &self.course.bends(to));
        if let Some((time, place)) = first {
            self.forces[place] = 0.0;
            self.met(time, place);
        }
        true
    }

    /// Some contacts press: until one is left, another is met, or the shape gives way.
    fn pressed(&mut self, stop: f64) -> bool {
        let from = self.path.end;
        let still =
            [0.5, 1.0].iter().all(|share| self.course.bends(from + share * (stop - from)) == self.course.bends(from));
        let (mut to, mut back, mut buckles) = (stop, BACK * self.whole, None);
        loop {
            let cut = self.cut(TERMS[self.terms]);
            match self.solve(&cut, from, to, still) {
                Err(Short::Coarse) => self.terms += 1,
                Ok(solved) => {
                    let went = self.take(&cut, solved, to);
                    // Unless something else happened before.
                    return if buckles == Some(self.path.end) { self.give_up(What::Buckled) } else { went };
                }
                Err(Short::Buckles(good, bad)) if good > from => {
                    // A little before: what is stable from one start may not be from another.
                    to = (self.buckling(&cut, good, bad) - back).max(good);
                    (back, buckles) = (10.0 * back, Some(to));
                }
                Err(Short::Buckles(_, bad)) if bad - from > SHORTEST * self.whole => to = 0.5 * (from + bad),
                Err(Short::Buckles(..)) => return self.give_up(What::Buckled),
                Err(Short::Rough) if to - from > SHORTEST * self.whole => to = from + 0.5 * (to - from),
                Err(Short::Rough) => return self.give_up(What::Lost),
            }
        }
    }

    fn give_up(&mut self, what: What) -> bool {
        self.path.happened.push(Happened { time: self.path.end, what });
        false
    }

    /// One shape with the contacts of now held.
    fn node(&self, cut: &Cut, time: f64, start: Unknowns) -> Option<(Node, Near)> {
        let bends = self.course.bends(time);
        let flat: Vec<f64> = bends[..cut.layout.segments()].iter().flat_map(|bends| [bends.x, bends.y]).collect();
        let held: Vec<Held> = self
            .active
            .iter()
            .filter_map(|place| cut.standing.iter().position(|other| other == place))
            .map(|place| cut.planes[place])
            .collect();
        let mut near = nearby(&cut.layout, &flat, &held, start)?;
        // Second derivatives are those of a small step before: near buckling, its own are wanted.
        if !is_stable(&near.hessian, &near.gradients, DOUBTFUL) {
            near = nearby(&cut.layout, &flat, &held, near.at)?;
        }
        let gap = |(place, plane): (&usize, &Held)| {
            let end = near.shape.ends[plane.piece].position;
            if self.active.contains(place) { 0.0 } else { plane.offset - plane.normal.dot(&end) }
        };
        let gaps = cut.standing.iter().zip(&cut.planes).map(gap).collect();
        let ends = self.ends(cut, &near.at.x, &bends, &near.shape.ends);
        let free = free::poses(self.rods, &bends);
        let from_free = from_free(&free, ends.into_iter(), self.units);
        Some((Node { time, from_free, at: near.at.clone(), gaps }, near))
    }

    /// End disks up to the last segment with a contact, in units of length.
    fn ends(&self, cut: &Cut, x: &DVector<f64>, bends: &[Bends], ends: &[Pose]) -> Vec<Pose> {
        let layout = &cut.layout;
        let mut disks: Vec<Pose> = (0..layout.segments()).map(|segment| ends[layout.last_piece(segment)]).collect();
        if let (Some(rest), Some(last)) = (layout.rest, disks.last_mut()) {
            let own = bends[layout.segments() - 1];
            let bent = Bends::from_fn(|i, _| own[i] * rest.share + x[rest.modes[i]] * rest.bend);
            let (end, _) = free::end(rest.length, configuration(&bent));
            *last =
                Pose { position: last.position + last.rotation * end.position, rotation: last.rotation * end.rotation };
        }
        disks
    }

    /// All nodes between two times.
    fn solve(&self, cut: &Cut, from: f64, to: f64, still: bool) -> Result<Solved, Short> {
        let (mut nodes, mut margins): (Vec<Node>, _) = (Vec::new(), [1.0; 3]);
        let mut start = self.start(cut);
        for time in points(from, to).take(if still { 1 } else { usize::MAX }) {
            if let Some(next) = led(&nodes, time) {
                start = next;
            }
            let (node, near) = self.node(cut, time, start).ok_or(Short::Rough)?;
            if !is_stable(&near.hessian, &near.gradients, LEAST_MARGIN) {
                return Err(Short::Buckles(nodes.last().map_or(from, |node| node.time), time));
            }
            if nodes.len().is_multiple_of(STEPS / 2) {
                margins[nodes.len() / (STEPS / 2)] = margin(&near.hessian, &near.gradients);
            }
            if cut.layout.tail(&near.at.x) > TAIL && self.terms + 1 < TERMS.len() {
                return Err(Short::Coarse);
            }
            start = near.at;
            nodes.push(node);
        }
        let (layout, unit, length) = (Arc::clone(&cut.layout), self.units.force(), self.units.length);
        let solved = Solved { layout, unit, length, nodes, margins };
        if solved.is_smooth() { Ok(solved) } else { Err(Short::Rough) }
    }

    /// The last time at which the shape is stable, between one at which it is and one at which it is not.
    fn buckling(&self, cut: &Cut, mut good: f64, mut bad: f64) -> f64 {
        let mut start = self.start(cut);
        for _ in 0..40 {
            if bad - good < SHORTEST * self.whole {
                break;
            }
            let middle = 0.5 * (good + bad);
            match self.node(cut, middle, start.clone()) {
                Some((node, near)) if is_stable(&near.hessian, &near.gradients, LEAST_MARGIN) => {
                    good = middle;
                    start = node.at;
                }
                _ => bad = middle,
            }
        }
        good
    }

    /// Takes a stretch up to its first event.
    fn take(&mut self, cut: &Cut, solved: Solved, stop: f64) -> bool {
        let from = self.path.end;
        let times = || {
            let pairs = solved.nodes.windows(2).map(|pair| (pair[0].time, pair[1].time));
            pairs.flat_map(|(a, b)| (1..=LOOKS).map(move |k| a + (b - a) * k as f64 / LOOKS as f64))
        };
        let mut first: Option<(f64, What)> = None;
        let mut offer = |time: Option<f64>, what: What| {
            if let Some(time) = time
                && first.is_none_or(|(other, _)| time < other)
            {
                first = Some((time, what));
            }
        };
        for (row, &place) in self.active.iter().enumerate() {
            let force = |time: f64| solved.force(&solved.weights(time), row) + PULLS;
            offer(crossing(from, times(), force), What::Opened(place));
        }
        for (contact, &place) in cut.standing.iter().enumerate().filter(|(_, place)| !self.active.contains(place)) {
            let gap = |time: f64| solved.gap(&solved.weights(time), contact) + PASSED;
            offer(crossing(from, times(), gap), What::Met(place));
        }
        let to = first.map_or(stop, |(time, _)| time);
        let weights = solved.weights(to);
        for (row, &place) in self.active.iter().enumerate() {
            self.forces[place] = solved.force(&weights, row);
        }
        self.profile = Profile::of(&cut.layout, self.rods, &solved.x(&weights), &self.course.bends(to));
        self.push(to, Fit::Pressed(Arc::new(solved)));
        match first {
            Some((time, What::Met(place))) => {
                self.forces[place] = 0.0;
                self.met(time, place);
            }
            Some((time, what)) => {
                if let What::Opened(place) = what {
                    self.active.retain(|&other| other != place);
                    self.forces[place] = 0.0;
                }
                self.path.happened.push(Happened { time, what });
            }
            None => {}
        }
        true
    }
}

/// Where the nodes so far lead, by the polynomial through the last of them.
fn led(nodes: &[Node], time: f64) -> Option<Unknowns> {
    let last = &nodes[nodes.len().saturating_sub(4)..];
    if last.len() < 2 {
        return None;
    }
    let weight = |k: usize| {
        let others = last.iter().enumerate().filter(|(j, _)| *j != k);
        others.fold(1.0, |product, (_, other)| product * (time - other.time) / (last[k].time - other.time))
    };
    let (x, forces) = (&last[0].at.x * 0.0, &last[0].at.forces * 0.0);
    Some(last.iter().enumerate().fold(Unknowns { x, forces }, |sum, (k, node)| Unknowns {
        x: sum.x + &node.at.x * weight(k),
        forces: sum.forces + &node.at.forces * weight(k),
    }))
}

/// The first time after `from` at which a value is below 0.
fn crossing(from: f64, times: impl Iterator<Item = f64>, value: impl Fn(f64) -> f64) -> Option<f64> {
    let mut good = from;
    for time in times {
        if value(time) >= 0.0 {
            good = time;
            continue;
        }
        let mut bad = time;
        for _ in 0..60 {
            let middle = 0.5 * (good + bad);
            if middle <= good || middle >= bad {
                break;
            }
            if value(middle) < 0.0 { bad = middle } else { good = middle }
        }
        return Some(good);
    }
    None
}
