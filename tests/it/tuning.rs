//! The study of thresholds, held against single runs and against what is known beforehand.

use centrode_core::detect::Method as Lamp;
use centrode_core::run::{Run, simulate};
use centrode_core::scenario::Scenario;
use centrode_core::scenario::preset::find;
use centrode_core::scenario::{Place, Threshold, Xi1Rule};
use centrode_core::study::Job;
use centrode_core::study::remote::{Answer, Found, Remote, Request, Work};
use centrode_core::study::seed::repeat_seed;
use centrode_core::study::tuning::recommend::{Verdict, Wish, recommend};
use centrode_core::study::tuning::watch::{NEVER, Rule};
use centrode_core::study::tuning::{Spec, Study};

fn noisy(sets: &[&str]) -> Scenario {
    let mut draft = find("bench").and_then(|preset| preset.draft()).expect("bench");
    let noise = ["tracker.position_noise=0.00005", "tracker.orientation_noise=0.0002", "load_cells.noise=0.3"];
    noise.iter().chain(sets).for_each(|set| draft.set(set).expect(set));
    draft.finish().expect("valid")
}

fn study(scenario: &Scenario, repeats: usize, cells: &[&[&str]]) -> Study {
    let cells = cells.iter().map(|cell| cell.iter().map(|set| set.parse().expect(set)).collect()).collect();
    let spec = Spec { cells, ..Spec::of(scenario.clone(), repeats) };
    Study::new(spec).expect("a study")
}

/// The sample of a run's first alarm, from what the run itself reports: for one rule or either of them its crossings, for
/// both the samples at which both values lie above their thresholds.
fn first_alarm(scenario: &Scenario, rule: Rule) -> u32 {
    let run = simulate(scenario).expect("valid");
    let sample = |time: f64| run.samples().position(|sample| sample.time == time).expect("a sample") as u32;
    let crossed = |lamp: Lamp| {
        run.crossings().iter().find(|crossing| crossing.method == lamp).map_or(NEVER, |crossing| sample(crossing.time))
    };
    match rule {
        Rule::Fcd => crossed(Lamp::Fcd),
        Rule::Jfd => crossed(Lamp::Jfd),
        Rule::Or => crossed(Lamp::Fcd).min(crossed(Lamp::Jfd)),
        Rule::And => both(scenario, &run),
    }
}

/// The first sample at which both alarms are on. An alarm stays as it was while its value is undefined, that of the
/// centrode also while the tip hardly turns.
fn both(scenario: &Scenario, run: &Run) -> u32 {
    let detection = &scenario.detection;
    let (mut centrode, mut forces) = (false, false);
    for (k, sample) in run.samples().enumerate().filter(|(_, sample)| sample.time >= detection.armed_from) {
        let judged = &sample.judgement;
        let xi1 = match detection.xi1_rule {
            Xi1Rule::Constant => detection.xi1.value(),
            Xi1Rule::Bound => detection.xi1.value().map(|_| detection.xi1_factor * judged.shape_bound),
        };
        if judged.deviation.is_finite() && judged.speed > detection.min_speed {
            centrode = detection.xi2.value().is_some_and(|xi2| judged.deviation > xi2);
        }
        if judged.residual.is_finite() {
            forces = xi1.is_some_and(|xi1| judged.residual > xi1);
        }
        if centrode && forces {
            return k as u32;
        }
    }
    NEVER
}

#[test]
fn one_pass_gives_what_a_run_with_each_threshold_gives() {
    for sets in [
        &[][..],
        &["contact.disk=0"],
        &["detection.xi1_rule=bound", "load_cells.errors=independent"],
        &["detection.min_speed=0.3", "detection.armed_from=3.5"],
        &["detection.xi1=off"],
        &["contact.arc_length=0.002", "load.moment=[0,0.05,0]"],
    ] {
        let base = noisy(sets);
        let study = study(&base, 2, &[&[]]);
        let batch = study.cells()[0].held.unwrap_or(study.cells()[0].free);
        let repeat = 1;
        let firsts = study.run((batch, repeat));
        let levels = study.batches()[batch].levels.clone();
        let seed = repeat_seed(base.seed, repeat);
        for &rule in Rule::ALL {
            let values = rule.levels(&levels);
            // The smallest, the largest, and some between.
            for level in (0..values.len()).step_by(17).chain([values.len() - 1]) {
                let mut scenario = Scenario { seed, ..base.clone() };
                match (rule, scenario.detection.xi1_rule) {
                    (Rule::Jfd, Xi1Rule::Constant) => scenario.detection.xi1 = Threshold::On(values[level]),
                    (Rule::Jfd, Xi1Rule::Bound) => scenario.detection.xi1_factor = values[level],
                    _ => scenario.detection.xi2 = Threshold::On(values[level]),
                }
                if rule == Rule::Jfd && base.detection.xi1 == Threshold::OFF {
                    continue;
                }
                let expected = first_alarm(&scenario, rule);
                let found = firsts.alarms[rule as usize][level];
                assert_eq!(found, expected, "{sets:?} {rule:?} at {}", values[level]);
            }
        }
    }
}

#[test]
fn the_first_alarm_is_the_first_crossing_of_the_run() {
    let base = noisy(&[]);
    let study = study(&base, 1, &[&[]]);
    let run = simulate(&base).expect("valid");
    let firsts = study.run((study.cells()[0].held.expect("contact"), 0));
    for (lamp, rule) in [(Lamp::Fcd, Rule::Fcd), (Lamp::Jfd, Rule::Jfd)] {
        let level = study.own(0, rule).expect("its own threshold");
        let crossing = run.crossings().iter().find(|crossing| crossing.method == lamp).expect("an alarm");
        assert_eq!(run.plan.time(firsts.alarms[rule as usize][level] as usize), crossing.time);
    }
}

#[test]
fn the_order_of_work_changes_no_bit() {
    let base = noisy(&[]);
    let cells: &[&[&str]] = &[&[], &["filter.length=200"], &["contact.disk=3"]];
    let mut forward = study(&base, 7, cells);
    let mut backward = forward.clone();
    forward.finish();
    for piece in (0..backward.progress().of).rev() {
        let piece = backward.piece(piece);
        let firsts = backward.run(piece);
        backward.add(piece.0, &firsts);
    }
    assert_eq!(forward, backward);
    // Without contact, the third cell is the first.
    assert_eq!(forward.batches().len(), 5);
    assert_eq!(forward.cells()[0].free, forward.cells()[2].free);
    let mut adopted = study(&base, 7, &[&["filter.length=200"]]);
    adopted.adopt(&forward);
    assert!(adopted.missing().is_empty());
    assert_eq!(adopted.batches()[0].tally, forward.batches()[forward.cells()[1].free].tally);
}

#[test]
fn without_noise_the_study_is_the_run() {
    let paper = Scenario::default();
    let mut study = study(&paper, 3, &[&[]]);
    study.finish();
    let run = simulate(&paper).expect("valid");
    let level = study.own(0, Rule::Fcd).expect("7 mm");
    let point = study.point(0, Rule::Fcd, level);
    let seen = point.detection.expect("contact");
    assert_eq!((point.false_alarms.rate.count, seen.detected.count), (0, 3));
    let delay = run.detection().expect("found").time - study.contact_time(0).expect("contact");
    for value in [seen.mean, seen.median, seen.median_low, seen.ninety] {
        assert!((value - delay).abs() < 1e-12, "{value} for {delay}");
    }
    assert_eq!(seen.mean_error, 0.0);
    assert_eq!(study.contact_time(0), run.contact_time());
}

#[test]
fn higher_thresholds_are_quieter_and_later() {
    let mut study = study(&noisy(&[]), 20, &[&[]]);
    study.finish();
    for &rule in Rule::ALL {
        for pair in study.curve(0, rule).windows(2) {
            assert!(pair[0].false_alarms.rate.count >= pair[1].false_alarms.rate.count, "{rule:?}");
            let [low, high] = [&pair[0], &pair[1]].map(|point| point.detection.expect("contact"));
            assert!(low.early.count >= high.early.count, "{rule:?}");
        }
    }
    // Either alarms whenever one does; both, only when each does.
    let own = study.own(0, Rule::Fcd).expect("on");
    let alarms = |rule, level| study.point(0, rule, level).false_alarms.rate.count;
    let jfd = alarms(Rule::Jfd, study.own(0, Rule::Jfd).expect("on"));
    assert!(alarms(Rule::Or, own) >= alarms(Rule::Fcd, own).max(jfd));
    assert!(alarms(Rule::And, own) <= alarms(Rule::Fcd, own).min(jfd));
}

#[test]
fn a_recommendation_keeps_the_wish_and_is_the_soonest() {
    let lengths = [["filter.length=500"], ["filter.length=700"], ["filter.length=1000"]];
    let cells: Vec<&[&str]> = lengths.iter().map(|cell| &cell[..]).collect();
    let mut study = study(&noisy(&[]), 80, &cells);
    study.finish();
    let wish = Wish { rule: Rule::Fcd, false_alarm_rate: 0.1 };
    let Verdict::Take { cell, level, point } = recommend(&study, &wish) else { panic!("none") };
    assert_eq!(*point, study.point(cell, Rule::Fcd, level));
    assert!(point.false_alarms.rate.high <= 0.1);
    let median = point.detection.expect("contact").median;
    for cell in 0..3 {
        for other in study.curve(cell, Rule::Fcd) {
            let quiet = other.false_alarms.rate.high <= 0.1;
            let delay = other.detection.expect("contact").median;
            assert!(!quiet || delay.is_nan() || delay >= median, "{other:?}");
        }
    }
    // One in a thousand cannot be shown by 80 runs, however silent.
    let strict = Wish { false_alarm_rate: 1e-3, ..wish };
    assert_eq!(recommend(&study, &strict), Verdict::TooFewRuns { needed: 3838 });
}

#[test]
fn what_cannot_be_had_is_said() {
    let wish = Wish { rule: Rule::Fcd, false_alarm_rate: 0.2 };
    let verdict = |sets: &[&str], late: f64| {
        let mut study = study(&noisy(sets), 20, &[&[]]);
        study = Study::new(Spec { late, ..study.spec().clone() }).expect("a study");
        study.finish();
        recommend(&study, &wish)
    };
    assert_eq!(verdict(&["contact.disk=0"], 1.0), Verdict::NoContact);
    assert!(matches!(verdict(&["contact.arc_length=0.0001"], 0.3), Verdict::NoneFinds { best } if best < 0.5));
    // A tracker so bad that even the largest threshold alarms.
    let bad = verdict(&["tracker.position_noise=0.5", "detection.min_speed=0.001"], 1.0);
    assert!(matches!(bad, Verdict::NoneQuiet { lowest } if lowest > 0.2), "{bad:?}");
}

#[test]
fn impossible_specs_are_refused() {
    let spec = study(&Scenario::default(), 1, &[&[]]).spec().clone();
    let told = |spec: Spec| Study::new(spec).expect_err("refused").to_string();
    assert!(told(Spec { repeats: 0, ..spec.clone() }).contains("repeats = 0"));
    assert!(told(Spec { late: f64::NAN, ..spec.clone() }).contains("late = NaN"));
    let cells = vec![vec!["contact.disk=9".parse().expect("a disk")]];
    assert!(told(Spec { cells, ..spec.clone() }).contains("contact.disk = 9"));
    let mut scenario = Scenario::default();
    scenario.contact.place = Place::disk(7);
    assert!(told(Spec { scenario, ..spec }).contains("contact.disk = 7"));
}

#[test]
fn a_study_made_elsewhere_is_the_study() {
    let mut here = study(&noisy(&["detection.xi1=off"]), 5, &[&[], &["filter.length=200"]]);
    let mut there = here.clone();
    here.finish();
    let work = Work::Thresholds { spec: there.spec().clone(), batches: there.missing() };
    let request = Request { id: 7, work };
    let mut remote = Remote::new(&serde_json::to_string(&request).expect("JSON")).expect("a request");
    let set = |study: &mut Study, answer: Answer| match answer.found {
        Found::Thresholds(tallies) => {
            tallies.into_iter().for_each(|(batch, tally)| assert!(study.set(batch as usize, tally)));
        }
        _ => panic!("it was asked for thresholds"),
    };
    let mut runs = 0;
    while remote.step() {
        runs += 1;
        // Answers at odd moments, as they come.
        if runs % 3 == 0 {
            let answer = Answer::from_bytes(&remote.answer().expect("bytes")).expect("an answer");
            assert_eq!(answer.id, 7);
            set(&mut there, answer);
        }
    }
    let last = Answer::from_bytes(&remote.answer().expect("bytes")).expect("an answer");
    set(&mut there, last);
    assert_eq!(runs, 4 * 5);
    assert_eq!(here, there);
    assert!(Remote::new("{}").is_err() && Answer::from_bytes(b"nonsense").is_err());
}
