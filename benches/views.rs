//! What one frame of each view costs on the CPU: `cargo bench --features app --bench views`.

use centrode::app::charts::plane::plane;
use centrode::app::charts::plots::{PlotState, plots};
use centrode::app::memo::Memo;
use centrode::scene::palette::Palette;
use centrode::show::track::Trace;
use centrode::show::{ViewOptions, view};
use centrode_core::run::simulate;
use centrode_core::scenario::Threshold;
use centrode_core::scenario::preset::find;
use criterion::{Criterion, criterion_group, criterion_main};
use egui::vec2;
use std::hint::black_box;

/// A time within the contact, s.
const CURSOR: f64 = 6.9;

fn views(c: &mut Criterion) {
    let run =
        find("bench").and_then(|preset| preset.scenario()).and_then(|scenario| simulate(&scenario)).expect("bench");
    let trace = Trace::new(&run);
    let mut group = c.benchmark_group("frame");
    let options = ViewOptions { palette: Palette::DARK, pulse: 0.0, frozen: false, placed: None };
    group.bench_function("scene of the 3D view", |b| b.iter(|| view(black_box(&run), &trace, CURSOR, &options)));
    let context = egui::Context::default();
    centrode::app::theme::install(&context);
    let mut state = PlotState::default();
    group.bench_function("three plots", |b| {
        b.iter(|| {
            context.run_ui(egui::RawInput::default(), |ui| {
                let mut out = Vec::new();
                ui.allocate_ui(vec2(1200.0, 240.0), |ui| plots(ui, (&run, 0), CURSOR, &mut state, &mut out));
            })
        });
    });
    group.bench_function("bending plane", |b| {
        b.iter(|| {
            context.run_ui(egui::RawInput::default(), |ui| {
                let mut out = Vec::new();
                ui.allocate_ui(vec2(400.0, 400.0), |ui| plane(ui, &run, &trace, (CURSOR, false, None), &mut out));
            })
        });
    });
    group.finish();
}

/// Everything one frame does while a threshold is dragged: thresholds over the evidence, and the three views.
fn dragging(c: &mut Criterion) {
    let mut scenario = find("bench").and_then(|preset| preset.scenario()).expect("bench");
    let mut memo = Memo::new(&scenario);
    let options = ViewOptions { palette: Palette::DARK, pulse: 0.0, frozen: false, placed: None };
    let context = egui::Context::default();
    centrode::app::theme::install(&context);
    let mut state = PlotState::default();
    let mut step = 0_u32;
    c.bench_function("frame/dragging xi2", |b| {
        b.iter(|| {
            step = (step + 1) % 50;
            scenario.detection.xi2 = Threshold::On(0.005 + 1e-5 * f64::from(step));
            memo.update(&scenario);
            let (run, trace) = (memo.run(), memo.trace());
            black_box(view(run, trace, CURSOR, &options));
            context.run_ui(egui::RawInput::default(), |ui| {
                let mut out = Vec::new();
                ui.allocate_ui(vec2(1200.0, 240.0), |ui| {
                    plots(ui, (run, memo.version()), CURSOR, &mut state, &mut out)
                });
                ui.allocate_ui(vec2(400.0, 400.0), |ui| plane(ui, run, trace, (CURSOR, false, None), &mut out));
            })
        });
    });
}

criterion_group!(benches, views, dragging);
criterion_main!(benches);
