// Khronos' glTF validator over files; exit status 1 if one has an error or a warning. It knows neither
// EXT_meshopt_compression nor MSFT_lod, and says so as information.
const fs = require('fs'), path = require('path');
const validator = require('gltf-validator');

async function main(files) {
  let bad = 0;
  for (const file of files) {
    const beside = async (uri) => new Uint8Array(fs.readFileSync(path.join(path.dirname(file), decodeURIComponent(uri))));
    const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), { externalResourceFunction: beside });
    for (const m of report.issues.messages.filter((m) => m.severity < 2)) {
      if (m.code === 'MESH_PRIMITIVE_GENERATED_TANGENT_SPACE' && file.includes('_leaves/')) continue;  // as the scene has it
      console.log(`${file}: ${m.code} ${m.pointer || ''} ${m.message}`);
      ++bad;
    }
  }
  process.exit(bad > 0 ? 1 : 0);
}

main(process.argv.slice(2));
