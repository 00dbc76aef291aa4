// The chip: rp2040js with a second core.
//
// rp2040js takes the cycles of each instruction from the datasheet. It does not count waits for memory:
// neither for flash, which the program keeps out of its inner loops, nor for a bank of RAM that both cores
// and DMA access.

import { RP2040 } from 'rp2040js';

import { Profile } from './profile.mjs';
import { addSecondCore } from './second_core.mjs';

const FLASH = 0x10000000;
/** The vectors follow the second stage of the boot loader, which the emulator skips. */
const VECTORS = 0x10000100;

/** Number of instructions between two tests of the condition to stop. */
const STRIDE = 64;

/** An RP2040 that runs a program. */
export class Chip {
  constructor(program) {
    this.mcu = new RP2040();
    // Print each warning once: rp2040js repeats the warnings about hardware that it does not model.
    const printed = new Set();
    const print = (name, message) => {
      if (!printed.has(message)) console.error(`${name}: ${message}`);
      printed.add(message);
    };
    const info = (_, message) => message === 'SEV' && this.wake();
    this.mcu.logger = { debug() {}, info, warn: print, error: print };
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

  /** Wakes all cores: rp2040js only logs the instruction SEV. */
  wake() {
    for (const core of this.cores) {
      core.eventRegistered = true;
      core.waiting = false;
    }
  }

  /** Executes instructions until a condition holds. */
  runUntil(holds) {
    const { clock } = this.mcu;
    const [first] = this.cores;
    do {
      for (let i = 0; i < STRIDE; i++) {
        const before = first.cycles;
        this.#step(first);
        clock.tick(((first.cycles - before) * 1e9) / this.clockHz);
        // Run the second core up to the first core's cycle.
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
