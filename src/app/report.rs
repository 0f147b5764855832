//! What the page tells the document around it.

use super::App;
use crate::app::chain;
use crate::app::stages::stage::Stage;
use crate::app::words;
use crate::app::words::story::{self, Phase};

impl App {
    /// The page in a line of JSON: state at the cursor, cursor (s), detection of the run (s, m), playing, and a sentence.
    #[must_use]
    pub fn report(&self) -> String {
        let (run, time) = (self.memo.run(), self.cursor());
        if let Some(memo) = self.chained() {
            let first = memo.told().first();
            return serde_json::json!({
                "state": chain::words::phase(memo, time).words().to_lowercase(),
                "time": time,
                "detection_time": first.map(|told| told.found.alarm),
                "location": first.and_then(|told| told.at(time)).map(|estimate| estimate.along.mean),
                "playing": self.state.playing,
                "summary": chain::words::sentence(memo),
                "said": chain::words::said(memo, time),
                "sound": null,
                "log": null,
                "tuning": null,
                "working": memo.is_working(),
            })
            .to_string();
        }
        serde_json::json!({
            "state": Phase::at(run, time).words().to_lowercase(),
            "time": time,
            "detection_time": run.detection().map(|detection| detection.time),
            "location": run.detection().map(|detection| detection.location),
            "playing": self.state.playing,
            "summary": match self.memo.recorded() {
                Some(recorded) => words::log::sentence(run, recorded),
                None => story::sentence(run),
            },
            "said": words::said::said(run, time),
            "sound": self.sound(),
            "log": self.log(),
            "tuning": match self.state.stage {
                Stage::Tuning => self.tuner.report(self.state.tuning.rule),
                Stage::Detectors => self.comparer.report(),
                _ => None,
            },
        })
        .to_string()
    }

    /// What is heard: the deviation over its threshold, while it is played and there are both; none without sound.
    fn sound(&self) -> Option<serde_json::Value> {
        if !self.state.sound || !self.state.playing {
            return None;
        }
        let run = self.memo.run();
        let threshold = run.plan.scenario().detection.xi2.value();
        let ratio = threshold.map(|xi2| run.sample_at(self.cursor()).judgement.deviation / xi2);
        // What is undefined is null in JSON.
        Some(serde_json::json!({ "ratio": ratio }))
    }
}
