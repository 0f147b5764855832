//! How long the core takes: `cargo bench`. Compare ratios within one run; absolute times differ between machines.

use centrode_core::model::{Assumption, Configuration, Constrained, Rate, locate};
use centrode_core::run::{Simulation, simulate};
use centrode_core::scenario::preset::find;
use centrode_core::scenario::{ContactKind, Plan, Scenario};
use centrode_core::study::Job;
use centrode_core::study::map::MapJob;
use centrode_core::study::table2::{PAPER_REPEATS, Table2Job};
use centrode_core::study::tuning::{Spec, Study};
use criterion::{Criterion, criterion_group, criterion_main};
use rayon::iter::{ParallelBridge, ParallelIterator};
use std::hint::black_box;
use std::sync::Mutex;

fn model(c: &mut Criterion) {
    let segment = Scenario::default().robot.segment();
    let rate = Rate { theta_l: -1.0, delta: 0.0 };
    let configuration = Configuration::from_theta_l(black_box(0.6), black_box(0.8));
    c.bench_function("model/configuration", |b| {
        b.iter(|| Configuration::from_theta_l(black_box(0.6), black_box(0.8)));
    });
    c.bench_function("model/pose, jacobian and centrode of the tip", |b| {
        b.iter(|| {
            let (pose, jacobian) = segment.arc(black_box(configuration)).pose_and_jacobian(segment.length);
            jacobian.centrode(&pose.position, rate)
        });
    });
    c.bench_function("model/energy gradient", |b| b.iter(|| segment.energy_gradient(black_box(&configuration))));
    let held = Constrained::new(0.03, 0.015, 0.9, configuration);
    let centrode = held.centrode(rate).expect("it moves");
    c.bench_function("model/locate", |b| {
        b.iter(|| locate(Assumption::default(), 0.03, configuration, rate, black_box(&centrode)))
    });
}

fn experiment(c: &mut Criterion) {
    let mut group = c.benchmark_group("simulate");
    for name in ["paper", "bench", "touch-2", "cylinder"] {
        let scenario = find(name).and_then(|preset| preset.scenario()).expect(name);
        group.bench_function(name, |b| b.iter(|| simulate(black_box(&scenario))));
    }
    let plan = Plan::new(&Scenario::default()).expect("valid");
    group.bench_function("paper, streamed without keeping samples", |b| {
        b.iter(|| Simulation::new(black_box(&plan)).map(|sample| sample.judgement.deviation).fold(0.0, f64::max));
    });
    group.finish();
}

fn study(c: &mut Criterion) {
    let scenario = Scenario::default();
    let mut flat = scenario.clone();
    flat.contact.kind = ContactKind::Plane;
    for (name, scenario, cells) in [("map/100 × 100", &scenario, 100), ("map/30 × 30, a flat beam", &flat, 30)] {
        c.bench_function(name, |b| {
            b.iter(|| {
                let mut job = MapJob::new(black_box(scenario), cells, cells).expect("valid");
                job.finish();
                job.map().deviation[cells * cells / 2]
            });
        });
    }
    let bench = find("bench").and_then(|preset| preset.scenario()).expect("bench");
    c.bench_function("table2/5 repeats", |b| {
        b.iter(|| {
            let mut job = Table2Job::new(black_box(&bench), PAPER_REPEATS).expect("valid");
            job.finish();
            job.table().simulated[1].location.mean
        });
    });
}

/// What a slider of the page costs: a threshold, the filter, anything else.
fn update(c: &mut Criterion) {
    use centrode_core::scenario::Threshold;
    let bench = find("bench").and_then(|preset| preset.scenario()).expect("bench");
    let mut group = c.benchmark_group("update");
    type Change = fn(&mut Scenario, bool);
    let changes: [(&str, Change); 3] = [
        ("a threshold", |s, other| s.detection.xi2 = Threshold::On(if other { 0.006 } else { 0.007 })),
        ("the filter", |s, other| s.filter.length = if other { 400 } else { 500 }),
        ("the seed", |s, other| s.seed = u64::from(other)),
    ];
    for (name, change) in changes {
        let plans = [false, true].map(|other| {
            let mut scenario = bench.clone();
            change(&mut scenario, other);
            Plan::new(&scenario).expect("valid")
        });
        let mut run = simulate(&bench).expect("valid");
        let mut next = plans.iter().cycle();
        group.bench_function(name, |b| b.iter(|| next.next().map(|plan| run.update(plan.clone()))));
    }
    group.finish();
}

/// Thresholds over repeats, as the command makes them: 500 with contact and 500 without.
fn tuning(c: &mut Criterion) {
    let mut group = c.benchmark_group("tuning");
    group.sample_size(10);
    for name in ["paper", "bench"] {
        let scenario = find(name).and_then(|preset| preset.scenario()).expect(name);
        let spec = Spec::of(scenario, 500);
        let study = Study::new(spec).expect("a study");
        group.bench_function(format!("1000 runs of {name} on all cores"), |b| {
            b.iter(|| {
                let counted = Mutex::new(study.clone());
                (0..study.progress().of).par_bridge().for_each(|piece| {
                    let piece = study.piece(piece);
                    let firsts = study.run(piece);
                    counted.lock().expect("no panic").add(piece.0, &firsts);
                });
                counted.into_inner().expect("no panic").point(0, centrode_core::study::tuning::watch::Rule::Fcd, 69)
            });
        });
    }
    group.finish();
}

/// What the calibration filter costs: gains once a plan, a run by each detector, one place.
fn detect(c: &mut Criterion) {
    use centrode_core::detect::Method;
    use centrode_core::detect::calibration::course::{Listener, Planner};
    use centrode_core::detect::calibration::cusum;
    use centrode_core::detect::estimates::{Placing, marginal};
    use centrode_core::scenario::{Choice, Kind};
    let mut scenario = find("miscalibrated").and_then(|preset| preset.scenario()).expect("miscalibrated");
    scenario.detection.detectors.set(Method::Cusum, true);
    let run = simulate(&scenario).expect("valid");
    let watched = run.judged.watched.as_ref().expect("cusum judges");
    let (model, commands, poses) = (&watched.model, &watched.readings.commands, &watched.readings.poses);
    let age = cusum::age(model, commands.iter().copied());
    let mut group = c.benchmark_group("detect");
    group.bench_function("gains", |b| b.iter(|| Planner::all(model, black_box(commands), false).len()));
    for (name, with_bank) in [("filter and cusum", false), ("filter, cusum and glr", true)] {
        let moments = Planner::all(model, commands, with_bank);
        group.bench_function(format!("{name}, one run of {} readings", poses.len()), |b| {
            b.iter(|| {
                let mut listener = Listener::new(model, age);
                let heard =
                    moments.iter().zip(poses).map(|(moment, pose)| listener.hear(moment, black_box(pose)).cusum);
                heard.fold(0.0, f64::max)
            });
        });
    }
    let alarm = run.judged.first(Method::Cusum).expect("found").raised;
    for (name, plants) in [("a clamp", &[Kind::Clamp][..]), ("a clamp or a plane", &[Kind::Clamp, Kind::Plane])] {
        let placing = Placing { plants: Choice::of(plants), ..run.judged.settings.placing };
        for after in [0.0, 0.1, 0.5] {
            group.bench_function(format!("place of {name}, {after} s after the alarm"), |b| {
                b.iter(|| marginal(watched, &placing, alarm, black_box(alarm + after)).map(|found| found.place.mean));
            });
        }
    }
    group.finish();
}

/// A log of a million rows of thirteen columns: read, then put on the loop's clock.
fn log(c: &mut Criterion) {
    use centrode_core::record::Recorder;
    use centrode_core::record::log::{Log, Options, Setup, assemble, write};
    let mut scenario = find("bench").and_then(|preset| preset.scenario()).expect("bench");
    (scenario.motion.finish, scenario.motion.end) = (900.0, 999.999);
    let plan = Plan::new(&scenario).expect("valid");
    let mut text = write::csv_header();
    Recorder::new(&plan).for_each(|(entry, _)| write::csv_row(&mut text, &entry));
    let bytes = text.into_bytes();
    let mut group = c.benchmark_group("log");
    group.sample_size(10);
    let read = || Log::read("log.csv", black_box(bytes.clone()), &Options::default()).expect("a log");
    group.bench_function("read 1e6 rows of CSV", |b| b.iter(|| read().readings.len()));
    let log = read();
    assert_eq!(log.readings.len(), 1_000_000);
    group.bench_function("assemble 1e6 rows", |b| {
        b.iter(|| {
            assemble(black_box(&log), &scenario, &Setup::default()).expect("a recording").recording.entries.len()
        });
    });
    group.finish();
}

/// One shape of three segments, from nothing: followed as it bends from straight.
fn chain(c: &mut Criterion) {
    use centrode_core::model::Vec3;
    use centrode_core::model::chain::free::point;
    use centrode_core::model::chain::{Contact, Rod, Torsion, settle};
    let at = [(0.8, 0.3), (0.7, 2.0), (0.6, -1.0)].map(|(bend, delta)| Configuration::new(bend, delta));
    let met = [(0.5, 0.3), (0.4, 2.0), (0.4, -1.0)].map(|(bend, delta)| Configuration::new(bend, delta));
    let plane = |segment: usize| {
        let (before, after) = (point(&[0.03; 3], &met, segment, 0.015), point(&[0.03; 3], &at, segment, 0.015));
        let normal: Vec3 = (after.position - before.position).normalize();
        Contact { segment, at: 0.015, normal, offset: normal.dot(&before.position) }
    };
    let mut group = c.benchmark_group("chain");
    for (name, torsion) in [("rigid in torsion", Torsion::Rigid), ("twisting", Torsion::Ratio(5.0))] {
        let rods = [3e-3, 2e-3, 1e-3].map(|bending_stiffness| Rod { length: 0.03, bending_stiffness, torsion });
        for (count, segments) in
            [("no contact", &[][..]), ("a contact on segment 3", &[2]), ("contacts on 1 and 3", &[0, 2])]
        {
            let contacts: Vec<Contact> = segments.iter().map(|segment| plane(*segment)).collect();
            group.bench_function(format!("{count}, {name}"), |b| {
                b.iter(|| settle(black_box(&rods), &at, &contacts).expect("stable").margin);
            });
        }
    }
    group.finish();
}

/// Ten seconds of three segments: planned, which follows every shape; then recorded and judged.
fn chain_run(c: &mut Criterion) {
    use centrode_core::scenario::ChainPlan;
    use centrode_core::scenario::preset::find_chain;
    use centrode_core::study::chain::ChainRun;
    let mut group = c.benchmark_group("chain run");
    for name in ["three-segments", "two-contacts"] {
        let scenario = find_chain(name).and_then(|preset| preset.chain(&[]).ok()).expect("valid");
        group.bench_function(format!("{name}, planned"), |b| {
            b.iter(|| ChainPlan::new(black_box(&scenario)).expect("stable").samples());
        });
        let plan = ChainPlan::new(&scenario).expect("stable");
        group.bench_function(format!("{name}, recorded and judged"), |b| {
            b.iter(|| ChainRun::new(black_box(plan.clone())).judged.events.len());
        });
    }
    group.finish();
}

criterion_group!(benches, model, chain, chain_run, experiment, update, study, tuning, detect, log);
criterion_main!(benches);
