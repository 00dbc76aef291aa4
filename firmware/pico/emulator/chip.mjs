// The chip: rp2040js, to which a second core is added.
//
// rp2040js takes the cycles of each instruction from the datasheet. Nothing waits for memory: neither for flash, which the
// program therefore keeps out of its inner loops, nor where both cores and DMA want the same bank of RAM.

import { RP2040 } from 'rp2040js';

import { Profile } from './profile.mjs';
import { addSecondCore } from './second_core.mjs';

const FLASH = 0x10000000;
/** Behind the second stage of the boot loader, which would set up the flash chip. */
const VECTORS = 0x10000100;

/** How many instructions are executed before it is asked whether to go on. */
const STRIDE = 64;

/** An RP2040 that runs a program. */
export class Chip {
  constructor(program) {
    this.mcu = new RP2040();
    // Of what it has not modelled it warns, each time; a program that needs it does not get far.
    const told = new Set();
    const tell = (name, message) => {
      if (!told.has(message)) console.error(`${name}: ${message}`);
      told.add(message);
    };
    this.mcu.logger = { debug() {}, info: (_, message) => message === 'SEV' && this.wake(), warn: tell, error: tell };
    for (const { address, bytes } of program.pieces) this.mcu.flash.set(bytes, address - FLASH);
    const { core } = this.mcu;
    core.VTOR = VECTORS;
    core.reset();
    this.cores = [core];
    this.instructions = 0;
    this.profile = new Profile();
    addSecondCore(this);
  }

  /** The static memory. */
  get memory() {
    return this.mcu.sram;
  }

  /** The clock that both cores run at. */
  get clockHz() {
    return this.mcu.clkSys;
  }

  /** Cycles of the clock so far, and instructions of all cores. */
  get count() {
    return { cycles: this.mcu.core.cycles, instructions: this.instructions };
  }

  /** Whether a pin is an output, and high. */
  isHigh(pin) {
    const { outputEnable, outputValue } = this.mcu.gpio[pin];
    return outputEnable && outputValue;
  }

  /** An event for all cores, which rp2040js only logs. */
  wake() {
    for (const core of this.cores) {
      core.eventRegistered = true;
      core.waiting = false;
    }
  }

  /** Executes instructions until something holds. */
  runUntil(holds) {
    const { clock } = this.mcu;
    const [first] = this.cores;
    do {
      for (let i = 0; i < STRIDE; i++) {
        const before = first.cycles;
        this.#step(first);
        clock.tick(((first.cycles - before) * 1e9) / this.clockHz);
        // The second core, once it runs, keeps up.
        const second = this.cores[1];
        while (second && second.cycles < first.cycles) this.#step(second);
      }
    } while (!holds());
  }

  #step(core) {
    if (core.waiting) {
      core.cycles += 1;
    } else {
      const { PC: address, cycles } = core;
      core.executeInstruction();
      this.instructions += 1;
      this.profile.add(address, core.cycles - cycles);
    }
  }
}
