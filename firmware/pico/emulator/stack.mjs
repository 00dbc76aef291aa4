// Measures the stack: paints the free memory, and later counts how much paint is left.

const RAM = 0x20000000;
const PAINT = 0xa5;

/** The memory between the statics and the start of the first core's stack. */
export class PaintedStack {
  constructor(memory, program) {
    const [end, start] = ['_stack_end', '_stack_start'].map((name) => program.symbol(name) - RAM);
    this.room = memory.subarray(end, start);
    this.room.fill(PAINT);
  }

  /** The largest number of bytes of stack that were in use. */
  get used() {
    const deepest = this.room.findIndex((byte) => byte !== PAINT);
    if (deepest === 0) throw new Error('the stack grew into the statics: choose a smaller --size');
    return deepest < 0 ? 0 : this.room.length - deepest;
  }
}
