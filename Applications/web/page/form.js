// Options as fields, made of the program's own table: names, defaults and words are those of --help.

const kinds = new Set(['text', 'integer', 'real', 'choice', 'flag']);
const ours = new Set([
  'labels',
  'force',
  'threads',
  'progress',
  'quiet',
  'json',
  'memory',
  'html-triangles',
  'engine',
  'cross-check',
  'blocks',
  'block',
  'block-size',
  'level',
  'soma',
  'within',
]); // of files and of the machine, or this page's

/** Of which commands a row is: the curve skeleton is a run of its own here, so that `core` has none of its options. */
const isOf = (row, command) => row.commands.includes(command) && !(command === 'core' && row.group === 'Skeleton');

/** Rows of the table that a page can ask for: an option, and the commands it is of. */
export function rowsOf(table, commands) {
  return table.options.filter(
    (row) =>
      kinds.has(row.kind) && row.flags !== '' && !ours.has(row.name) && commands.some((name) => isOf(row, name)),
  );
}

const keyOf = (row) => `${row.name}/${row.commands.join('+')}`;

export class Form {
  constructor(table, { main, more, inFront, commands }) {
    this.rows = rowsOf(table, commands);
    this.fields = new Map();
    const groups = new Map();
    const twice = (row) => this.rows.filter(({ name }) => name === row.name).length > 1;
    for (const row of this.rows) {
      const front = inFront.has(row.name);
      if (!front && !groups.has(row.group)) {
        const group = document.createElement('div');
        group.className = 'group';
        group.append(Object.assign(document.createElement('h3'), { textContent: row.group }));
        groups.set(row.group, group);
        more.append(group);
      }
      this.fields.set(
        keyOf(row),
        this.#field(row, front ? main : groups.get(row.group), front, twice(row), commands),
      );
    }
    this.groups = groups;
  }

  #field(row, place, front, twice, commands) {
    const id = `option-${this.fields.size}`;
    const label = Object.assign(document.createElement('label'), { htmlFor: id });
    const words = row.name.replaceAll('-', ' ');
    label.textContent =
      words[0].toUpperCase() +
      words.slice(1) +
      (twice ? ` (${commands.filter((name) => isOf(row, name)).join(', ')})` : '');
    label.title = row.description;
    const note = Object.assign(document.createElement('p'), {
      className: 'note',
      id: `${id}-note`,
      textContent: row.description,
    });
    let input;
    const elements = [label];
    if (row.kind === 'flag') {
      input = Object.assign(document.createElement('input'), { type: 'checkbox' });
      label.className = 'flag';
      label.prepend(input);
    } else if (row.kind === 'choice') {
      input = document.createElement('select');
      if (row.default === '') input.add(new Option('—', ''));
      for (const word of row.placeholder.split('|')) input.add(new Option(word, word === row.default ? '' : word));
      elements.push(input);
    } else {
      input = Object.assign(document.createElement('input'), {
        type: 'text',
        placeholder: row.default || row.placeholder,
        autocomplete: 'off',
        spellcheck: false,
      });
      elements.push(input);
    }
    input.id = id;
    input.dataset.option = row.name;
    input.dataset.group = row.group;
    if (!front) {
      input.setAttribute('aria-describedby', note.id);
      elements.push(note);
    }
    place.append(...elements);
    return { row, input, elements };
  }

  /** Shows the fields of these commands alone. */
  show(commands) {
    for (const { row, elements } of this.fields.values()) {
      const hidden = !commands.some((name) => isOf(row, name));
      for (const element of elements) element.hidden = hidden;
    }
    for (const group of this.groups.values()) {
      group.hidden = [...group.querySelectorAll('label')].every(({ hidden }) => hidden);
    }
  }

  /** Takes the options of a preset, and the defaults for all the rest but how the scan is read. */
  fill(steps) {
    for (const { row, input } of this.fields.values()) {
      if (row.group === 'Input') continue;
      const step = steps.find(([command, options]) => isOf(row, command) && options[row.name] !== undefined);
      const value = step?.[1][row.name];
      if (row.kind === 'flag') {
        input.checked = value === true;
      } else {
        input.value = value === undefined || value === row.default ? '' : String(value);
      }
    }
  }

  /** The words of a command line for one command; of one group of options, if it is named. */
  argumentsOf(command, group) {
    const found = [];
    for (const { row, input } of this.fields.values()) {
      if (!isOf(row, command) || (group && row.group !== group)) continue;
      if (row.kind === 'flag') {
        if (input.checked) found.push(`--${row.name}`);
      } else if (input.value.trim() !== '') {
        found.push(`--${row.name}=${input.value.trim()}`);
      }
    }
    return found;
  }
}
