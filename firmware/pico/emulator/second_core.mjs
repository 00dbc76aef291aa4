// The second core, which rp2040js lacks: a second processor of rp2040js on the same buses (Raspberry Pi,
// "RP2040 Datasheet", 2.3 "Processor subsystem" and 2.8.2 "Launching code on processor core 1").

// Registers of the single-cycle IO block.
const CPUID = 0x000;
const FIFO_STATUS = 0x050;
const FIFO_WRITE = 0x054;
const FIFO_READ = 0x058;
/** Whether a register belongs to the core that accesses it: divider and interpolators. */
const isOwn = (offset) => offset >= 0x060 && offset < 0x100;

const VALID = 1;
const READY = 2;
const DEPTH = 8;

/** Whether a register is one of the core's memory protection, which has no effect here. */
const isProtection = (offset) => offset >= 0xd90 && offset <= 0xda0;

/** Adds the second core to a chip. It sleeps until the first core sends it the address of its program. */
export function addSecondCore(chip) {
  const { mcu } = chip;
  const [toFirst, toSecond] = [[], []];

  // The second core's view of the chip: it has its own IO block, timer and interrupts, and shares everything
  // else.
  const view = Object.create(mcu);
  view.core = new mcu.core.constructor(view);
  view.ppb = new mcu.ppb.constructor(view, 'PPB');
  view.sio = new mcu.sio.constructor(view);
  const { readUint32, writeUint32 } = protoOf(view.ppb);
  view.ppb.readUint32 = (offset) => (isProtection(offset) ? 0 : readUint32.call(view.ppb, offset));
  view.ppb.writeUint32 = (offset, value) => isProtection(offset) || writeUint32.call(view.ppb, offset, value);

  const shared = { sio: mcu.sio, ...protoOf(mcu.sio) };
  connect(mcu.sio, shared, { id: 0, incoming: toFirst, outgoing: toSecond, wake: () => chip.wake() });
  connect(view.sio, shared, { id: 1, incoming: toSecond, outgoing: toFirst, wake: () => chip.wake() });

  // The boot loader of the sleeping core: it echoes each word, and starts after 0, 0, 1, vectors, stack,
  // entry.
  const words = [];
  toSecond.push = (word) => {
    if (chip.cores.includes(view.core)) return Array.prototype.push.call(toSecond, word);
    toFirst.push(word);
    words.push(word);
    const [zero, one, vectors, stack, entry] = words.slice(-5);
    if (words.length < 6 || zero !== 0 || one !== 1) return 0;
    const { core } = view;
    core.VTOR = vectors;
    core.SP = stack;
    core.PC = entry & ~1;
    core.cycles = mcu.core.cycles;
    chip.cores.push(core);
    return 0;
  };
}

/** Connects an IO block to its core's number and to its ends of the two FIFOs. */
function connect(sio, shared, { id, incoming, outgoing, wake }) {
  const target = (offset) => (isOwn(offset) ? sio : shared.sio);
  sio.readUint32 = (offset) => {
    switch (offset) {
      case CPUID:
        return id;
      case FIFO_STATUS:
        return (incoming.length > 0 ? VALID : 0) | (outgoing.length < DEPTH ? READY : 0);
      case FIFO_READ:
        return incoming.shift() ?? 0;
      default:
        return shared.readUint32.call(target(offset), offset);
    }
  };
  sio.writeUint32 = (offset, value) => {
    switch (offset) {
      case FIFO_STATUS:
        return;
      case FIFO_WRITE:
        outgoing.push(value);
        wake();
        return;
      default:
        shared.writeUint32.call(target(offset), offset, value);
    }
  };
}

/** The methods of a block's class. */
function protoOf(block) {
  const { readUint32, writeUint32 } = Object.getPrototypeOf(block);
  return { readUint32, writeUint32 };
}
