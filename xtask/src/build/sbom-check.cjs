// Holds a file against the schema of CycloneDX; the same with a type that there is not has to be noticed.
const { Spec, Validation } = require("@cyclonedx/cyclonedx-library");
const validator = new Validation.JsonStrictValidator(Spec.Version.v1dot6);
const text = require("fs").readFileSync(process.argv[2], "utf8");
const spoilt = text.replace('"type": "library"', '"type": "nothing"');
if (spoilt === text) throw new Error("there is no library in it");
Promise.all([text, spoilt].map((text) => validator.validate(text))).then(([wrong, noticed]) => {
  if (wrong) throw new Error(JSON.stringify(wrong, null, 2));
  if (!noticed) throw new Error("the validator takes anything");
}).catch((error) => { console.error(error.message); process.exit(1); });
