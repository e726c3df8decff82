// A worker that runs the program: {module, args, files} in; {step} for each step, then {done}, what runProgram() gives.
// Without args it gives the table of options.

import { readTable, runProgram } from './engine.js';

const isNode = typeof process === 'object' && process.versions?.node !== undefined;
let port = globalThis;

async function run({ module, args, files }) {
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
    const done = await runProgram(module, args, { files, onErrorLine });
    port.postMessage({ done }, done.files.map(([, bytes]) => bytes.buffer));
  } catch (reason) {
    port.postMessage({ failed: String(reason) });
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
