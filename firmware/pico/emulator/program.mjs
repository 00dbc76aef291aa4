// The linked program: an ELF file, 32 bits, little endian (Tool Interface Standard, "Executable and Linking
// Format", 1995).

import { readFileSync } from 'node:fs';

const LOAD = 1;
const SYMBOL_TABLE = 2;

/** A linked program. */
export class Program {
  constructor(file) {
    this.bytes = readFileSync(file);
    const isElf = this.bytes.readUInt32BE(0) === 0x7f454c46;
    if (!isElf) throw new Error(`${file} is not an ELF file: build the program again`);
  }

  /** The pieces of flash, each with its address. */
  get pieces() {
    return this.#table(28, 42)
      .filter((header) => header.readUInt32LE(0) === LOAD && header.readUInt32LE(16) > 0)
      .map((header) => ({ address: header.readUInt32LE(12), bytes: this.#part(header, 4, 16) }));
  }

  /** The value of a symbol. */
  symbol(name) {
    const sections = this.#table(32, 46);
    for (const section of sections.filter((section) => section.readUInt32LE(4) === SYMBOL_TABLE)) {
      const symbols = this.#part(section, 16, 20);
      const names = this.#part(sections[section.readUInt32LE(24)], 16, 20);
      for (let at = 0; at < symbols.length; at += 16) {
        const start = symbols.readUInt32LE(at);
        if (names.toString('latin1', start, names.indexOf(0, start)) === name) return symbols.readUInt32LE(at + 4);
      }
    }
    throw new Error(`the program has no symbol ${name}`);
  }

  /**
   * The rows of a table. Its offset is at place `offset` of the file; row length and count are at place
   * `shape`.
   */
  #table(offset, shape) {
    const start = this.bytes.readUInt32LE(offset);
    const [length, rows] = [this.bytes.readUInt16LE(shape), this.bytes.readUInt16LE(shape + 2)];
    const row = (index) => this.bytes.subarray(start + index * length, start + (index + 1) * length);
    return Array.from({ length: rows }, (_, index) => row(index));
  }

  /** A part of the file. Its offset and length are at these places of a header. */
  #part(header, offset, length) {
    const start = header.readUInt32LE(offset);
    return this.bytes.subarray(start, start + header.readUInt32LE(length));
  }
}
