// The page's parameters: one table. A value that is not allowed is named to the person, never ignored.

const PARAMETERS = {
  renderer: { fallback: "auto", allowed: ["auto", "webgpu", "webgl"], means: "what to draw with" },
  worker: { fallback: "auto", allowed: ["auto", "off"], means: "whether studies are made and logs are read beside the page" },
  embed: { absent: "off", bare: "all", fallback: "all", allowed: ["robot", "plots", "tuning", "all"], means: "what of the page a frame shows" },
  origins: { fallback: [], list: origin, means: "the origins of host pages that may send messages, see docs/EMBED.md" },
  test: { fallback: false, flag: true, means: "opened by a test" },
};
// Added to links by mail programs and social sites; none of the person's doing.
const FOREIGN = /^(utm_.*|fbclid|gclid|msclkid|ref)$/;

/// `{ settings, notices }` from `location.search`.
export function readQuery(search) {
  const query = new URLSearchParams(search);
  const settings = {};
  const notices = [];
  for (const [name, parameter] of Object.entries(PARAMETERS)) {
    const values = query.getAll(name);
    settings[name] = values.length > 0 ? read(name, parameter, values, notices) : (parameter.absent ?? parameter.fallback);
  }
  for (const name of new Set(query.keys())) {
    if (Object.hasOwn(PARAMETERS, name) || FOREIGN.test(name)) continue;
    const known = Object.keys(PARAMETERS).filter((key) => !PARAMETERS[key].flag);
    notices.push(`There is no parameter “${clip(name)}”, so it was ignored. Known parameters: ${known.join(", ")}.`);
  }
  return { settings, notices };
}

function read(name, { fallback, allowed, flag, bare, list }, values, notices) {
  if (flag) return true;
  if (list) return values.join(",").split(",").map((text) => list(name, text, notices)).filter((item) => item !== null);
  if (values.length > 1) {
    notices.push(`${name} is given ${values.length} times; the first value was used.`);
  }
  if (bare && values[0] === "") return bare;
  const value = values[0];
  if (allowed.includes(value)) return value;
  notices.push(`${name}=${clip(value)} is not allowed, so ${fallback} was used. Allowed values: ${allowed.join(", ")}.`);
  return fallback;
}

/// An origin as browsers write it; null, and a notice, for what is none.
function origin(name, text, notices) {
  const url = URL.parse ? URL.parse(text) : URL.canParse?.(text) ? new URL(text) : null;
  const plain = url && /^https?:$/.test(url.protocol) && `${url.origin}${url.href.endsWith("/") ? "/" : ""}` === url.href;
  if (plain && !url.username) return url.origin;
  notices.push(
    `${clip(text)} in ${name} is not an origin, so it was ignored. An origin is scheme, host and port, as in https://example.org; several have commas between them.`,
  );
  return null;
}

function clip(text) {
  const short = text.length > 60 ? `${text.slice(0, 60)}…` : text;
  return short === "" ? "(nothing)" : short;
}
