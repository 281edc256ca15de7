// Validates glTF files by Khronos' own validator, `gltf-validator` of npm, found by NODE_PATH: node gltf.cjs FILE…
// Prints every error and warning; exit status 1 where there is one.
"use strict";

const fs = require("fs");
const path = require("path");
const validator = require("gltf-validator");

// What the validator calls an error and a warning.
const WARNING = 1;

async function faults(file) {
  const beside = (uri) => fs.promises.readFile(path.join(path.dirname(file), decodeURIComponent(uri)));
  const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), {
    uri: path.basename(file),
    maxIssues: 0,
    externalResourceFunction: async (uri) => new Uint8Array(await beside(uri)),
  });
  return report.issues.messages.filter((message) => message.severity <= WARNING);
}

async function main(files) {
  let count = 0;
  for (const file of files) {
    for (const { code, message, pointer } of await faults(file)) {
      console.error(`${file}: ${code} at ${pointer ?? "/"}: ${message}`);
      count += 1;
    }
  }
  console.log(`${files.length} files, ${count} errors and warnings by gltf-validator ${validator.version()}`);
  return files.length > 0 && count === 0 ? 0 : 1;
}

main(process.argv.slice(2)).then(
  (status) => process.exit(status),
  (error) => {
    console.error(`${error}`);
    process.exit(2);
  },
);
