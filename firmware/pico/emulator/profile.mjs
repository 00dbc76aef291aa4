// Counts executions and cycles of each instruction.

const FLASH = 0x10000000;
const FLASH_SIZE = 0x200000;
const RAM = 0x20000000;
const RAM_SIZE = 0x42000;

/** The executions and cycles of each instruction in flash and RAM, on all cores. */
export class Profile {
  constructor() {
    this.memories = [[FLASH, FLASH_SIZE], [RAM, RAM_SIZE]].map(([start, size]) => ({
      start,
      times: new Float64Array(size / 2),
      cycles: new Float64Array(size / 2),
    }));
  }

  add(address, cycles) {
    const [flash, ram] = this.memories;
    const memory = address >= RAM ? ram : flash;
    const place = (address - memory.start) >>> 1;
    memory.times[place] += 1;
    memory.cycles[place] += cycles;
  }

  /** Sets all counts to zero. */
  clear() {
    for (const { times, cycles } of this.memories) {
      times.fill(0);
      cycles.fill(0);
    }
  }

  /** A line for each instruction that was executed, in hexadecimal: address, executions, cycles. */
  toString() {
    const lines = [];
    for (const { start, times, cycles } of this.memories) {
      times.forEach((count, place) => {
        const numbers = [start + 2 * place, count, cycles[place]];
        if (count > 0) lines.push(numbers.map((number) => number.toString(16)).join(' '));
      });
    }
    return lines.join('\n');
  }
}
