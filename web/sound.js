// The sound of a run: a tone whose pitch follows the centrode's deviation, and a strike at an alarm. It is silent while nothing plays
// or nobody looks.

/// Pitch while there is no deviation and at its threshold, Hz: an octave apart.
const LOW = 220;
const VOLUME = 0.05;
/// How long a change takes to be heard, s.
const SOFT = 0.04;

let context = null;
let tone = null;
let gain = null;

function start() {
  context = new AudioContext();
  tone = new OscillatorNode(context, { type: "triangle", frequency: LOW });
  gain = new GainNode(context, { gain: 0 });
  tone.connect(gain).connect(context.destination);
  tone.start();
  // A browser lets a page sound only once a person has done something in it.
  for (const name of ["pointerup", "keydown"]) addEventListener(name, () => wanted && context.resume(), true);
  document.addEventListener("visibilitychange", () => play(null));
}

let wanted = false;

/// `ratio`: the deviation over its threshold; null for silence.
function play(ratio) {
  const heard = ratio !== null && !document.hidden;
  if (heard) tone.frequency.setTargetAtTime(LOW * 2 ** Math.min(ratio, 3), context.currentTime, SOFT);
  gain.gain.setTargetAtTime(heard ? VOLUME : 0, context.currentTime, SOFT);
}

function strike(pitch, type) {
  const now = context.currentTime;
  const note = new OscillatorNode(context, { type, frequency: pitch });
  const fade = new GainNode(context, { gain: 0 });
  fade.gain.setValueAtTime(4 * VOLUME, now);
  fade.gain.exponentialRampToValueAtTime(0.001, now + 0.5);
  note.connect(fade).connect(context.destination);
  note.start(now);
  note.stop(now + 0.5);
}

let last = null;

/// Takes what the program reports: `sound` is null while it is off or nothing plays, else `{ ratio }`.
export function sound({ sound, state }) {
  wanted = sound !== null && sound !== undefined;
  if (wanted && !context) start();
  if (context) {
    play(wanted ? (sound.ratio ?? null) : null);
    if (wanted && last !== null && state !== last && !document.hidden) {
      if (state === "detected") strike(1318, "sine");
      if (state === "false alarm") strike(165, "square");
    }
  }
  last = state;
  // For those who cannot hear it: tests.
  document.documentElement.dataset.sound = !wanted ? "off" : sound.ratio === null ? "silent" : "on";
}
