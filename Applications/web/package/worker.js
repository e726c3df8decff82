// A worker that runs the program: {module, args, files} in; {step} for each step, then {done}, what runProgram() gives.
// Without args it gives the table of options; with `most`, voxels of a scan.

import { readTable, readVoxels, runProgram } from './engine.js';

const isNode = typeof process === 'object' && process.versions?.node !== undefined;
let port = globalThis;

async function run({ module, args, files, most }) {
  const onErrorLine = (line) => {
    const isStep = line.startsWith('{"stage"');
    if (isStep) port.postMessage({ step: JSON.parse(line) });
    return isStep;
  };
  try {
    if (args === undefined) {
      port.postMessage({ done: await readTable(module) });
      return;
    }
    if (most !== undefined) {
      const scan = await readVoxels(module, args, most, files);
      port.postMessage({ done: scan }, scan ? [scan.values.buffer] : []);
      return;
    }
    const done = await runProgram(module, args, { files, onErrorLine });
    port.postMessage({ done }, done.files.map(([, bytes]) => bytes.buffer));
  } catch (reason) {
    port.postMessage({ failed: reason.message ?? String(reason) });
  }
}

if (isNode) {
  Promise.all([import('node:worker_threads'), import('node:crypto')]).then(([{ parentPort }, { webcrypto }]) => {
    globalThis.crypto ??= webcrypto; // Node 18 has it there only
    port = parentPort;
    port.on('message', run);
  });
} else {
  port.onmessage = ({ data }) => run(data);
}
