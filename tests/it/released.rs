//! A contact that is left again, and the next one.

use centrode_core::detect::calibration::course::{Listener, Model, Planner, planar};
use centrode_core::detect::calibration::{Belief, Command, Noise};
use centrode_core::model::contact::{clamped_tip, free_tip};

const LENGTH: f64 = 0.030;

#[test]
fn try_it() {
    let smooth = |from: f64, to: f64, t0: f64, t1: f64, t: f64| {
        let u = ((t - t0) / (t1 - t0)).clamp(0.0, 1.0);
        from + (to - from) * u * u * u * (10.0 + u * (6.0 * u - 15.0))
    };
    let bend = |t: f64| {
        let a = smooth(0.0, 1.0, 2.0, 6.0, t);
        let b = smooth(0.0, -0.7, 7.0, 10.0, t);
        let c = smooth(0.0, 1.0, 11.0, 15.0, t);
        a + b + c
    };
    let commands: Vec<Command> = (0..1700)
        .map(|k| {
            let time = f64::from(k) / 100.0;
            let rate = if [time < 2.0, time > 6.0 && time < 7.0, time > 10.0 && time < 11.0, time > 15.0].contains(&true) { 0.0 } else {
            (bend(time + 1e-4) - bend(time - 1e-4)) / 2e-4 };
            Command { time, bend: bend(time), rate, delta: 0.0 }
        })
        .collect();
    let noise = Noise { position: 5e-5, orientation: 0.01_f64.to_radians(), colour: 0.0 };
    for free in [0.0, 2.0_f64] {
    let model = Model { length: LENGTH, belief: Belief { free_bend: free.to_radians(), ..Belief::default() }, noise };
    let moments = Planner::all(&model, &commands, true);
    let mut listener = Listener::default();
    let mut source = 12345u64;
    let mut random = || {
        let mut sum = 0.0;
        for _ in 0..12 {
            source = source.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            sum += (source >> 11) as f64 / (1u64 << 53) as f64;
        }
        sum - 6.0
    };
    let met = 0.6;
    for (k, moment) in moments.iter().enumerate() {
        let bend = moment.command.bend;
        let tip = if bend > met { clamped_tip(0.5, met, bend) } else { free_tip(bend) } * LENGTH;
        let pose = planar(tip.x + 5e-5 * random(), tip.y + 5e-5 * random(), bend + 0.01_f64.to_radians() * random());
        let heard = listener.hear(moment, &pose);
        if k % 10 == 0 && k > 350 {
            println!("{free} {:.2} bend {bend:.3} {} cusum {:.1} glr {:.1} p {:.3}", moment.command.time, bend > met, heard.cusum, heard.glr, heard.contact);
        }
    }
    }
}
