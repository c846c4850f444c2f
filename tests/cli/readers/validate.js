// Prints the issues that the Khronos validator finds in a glTF file, and what the file has.
const fs = require("fs");
const [, , modules, file] = process.argv;
const validator = require(modules + "/gltf-validator");
validator.validateBytes(new Uint8Array(fs.readFileSync(file))).then((report) => {
  console.log(JSON.stringify({ issues: report.issues, info: report.info }));
});
