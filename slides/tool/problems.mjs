// The problems found in the slides, collected so that one run reports all.

export class Problems {
  #found = [];

  /** `line` 0 means the file as a whole. */
  add(file, line, text) {
    this.#found.push({ file, line, text });
  }

  get count() {
    return this.#found.length;
  }

  /** Returns those of the given files only. */
  of(files) {
    const some = new Problems();
    some.#found = this.#found.filter((one) => files.includes(one.file));
    return some;
  }

  print() {
    const order = (a, b) => (a.file === b.file ? a.line - b.line : a.file < b.file ? -1 : 1);
    for (const { file, line, text } of this.#found.sort(order)) {
      console.error(`${file}${line ? `:${line}` : ""}: ${text}`);
    }
  }
}

/** An error that the user sees as one line, without a stack trace. */
export class UserError extends Error {}
