// Writes options.d.ts, the types of all options by command, from the program's own table.
// usage: node types.js PACKAGE

import fs from 'node:fs';
import path from 'node:path';
import { pathToFileURL } from 'node:url';

const folder = path.resolve(process.argv[2]);
const { table } = await import(pathToFileURL(path.join(folder, 'index.js')));
const { commands, options } = await table();

const camel = (name) => name.replace(/-(.)/g, (_, letter) => letter.toUpperCase());

function typeOf({ kind, placeholder }) {
  if (kind === 'flag') return 'boolean';
  if (kind === 'choice') return placeholder.split('|').map((word) => `'${word}'`).join(' | ');
  if (kind === 'integer' || kind === 'real') return 'number | string';
  return 'string | number | (string | number)[]';
}

let text = '// Made by types.js from the table behind --help. Each option also goes by its name with hyphens.\n';
for (const { name, description } of commands) {
  const title = camel(`-${name}`);
  text += `\n/** Of ${name}: ${description} */\nexport interface ${title}Options {\n`;
  for (const option of options) {
    if (option.flags === '' || !option.commands.includes(name)) continue;
    const standard = option.default === '' ? '' : ` (default: ${option.default})`;
    text += `  /** ${option.description.replaceAll('*/', '* /')}${standard} */\n`;
    text += `  ${camel(option.name)}?: ${typeOf(option)};\n`;
  }
  text += '  [hyphenated: `${string}-${string}`]: unknown;\n}\n';
}
fs.writeFileSync(path.join(folder, 'options.d.ts'), text);
