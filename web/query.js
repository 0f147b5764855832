// The page's parameters: one table. A value that is not allowed is named to the person, never ignored.

const PARAMETERS = {
  renderer: { fallback: "auto", allowed: ["auto", "webgpu", "webgl"], means: "what to draw with" },
  worker: { fallback: "auto", allowed: ["auto", "off"], means: "whether studies are made and logs are read beside the page" },
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
    settings[name] = values.length > 0 ? read(name, parameter, values, notices) : parameter.fallback;
  }
  for (const name of new Set(query.keys())) {
    if (Object.hasOwn(PARAMETERS, name) || FOREIGN.test(name)) continue;
    const known = Object.keys(PARAMETERS).filter((key) => !PARAMETERS[key].flag);
    notices.push(`There is no parameter “${clip(name)}”, so it was ignored. Known parameters: ${known.join(", ")}.`);
  }
  return { settings, notices };
}

function read(name, { fallback, allowed, flag }, values, notices) {
  if (flag) return true;
  if (values.length > 1) {
    notices.push(`${name} is given ${values.length} times; the first value was used.`);
  }
  const value = values[0];
  if (allowed.includes(value)) return value;
  notices.push(`${name}=${clip(value)} is not allowed, so ${fallback} was used. Allowed values: ${allowed.join(", ")}.`);
  return fallback;
}

function clip(text) {
  const short = text.length > 60 ? `${text.slice(0, 60)}…` : text;
  return short === "" ? "(nothing)" : short;
}
