// Runs a program for the Pico until its panel has shown some frames, and reports what they took.
//
//     node main.mjs PROGRAM FRAMES
//
// The file `picture` gets the panel's pixels after each frame, as RGB565. The file `profile` gets the number
// of executions and cycles of each instruction. The standard output gets the figures, a line for each, in
// hexadecimal.

import { writeFileSync } from 'node:fs';

import { Chip } from './chip.mjs';
import { Panel } from './panel.mjs';
import { Program } from './program.mjs';
import { PaintedStack } from './stack.mjs';

/** The panel's pins, and the pin of the Pico's light, which the program turns on when it stops. */
const PINS = { data: 16, select: 17, backlight: 20, light: 25 };

/**
 * The frames that are not measured: the cores trace the first one while the panel starts, and are ahead of
 * the panel in the second.
 */
const EARLY = 2;

function run(program, frames) {
  const chip = new Chip(program);
  const stack = new PaintedStack(chip.memory, program);
  const panel = new Panel(chip, PINS);
  // A frame begins when the previous frame has been sent.
  const beginnings = [];
  panel.onFrame = () => {
    if (beginnings.length === EARLY) chip.profile.clear();
    beginnings.push({ ...chip.count, sending: panel.nanoseconds, picture: panel.picture() });
  };
  chip.runUntil(() => beginnings.length > EARLY + frames || chip.isHigh(PINS.light));
  if (chip.isHigh(PINS.light)) throw new Error('the program stopped, and turned on the light');

  const [first, last] = [beginnings[EARLY], beginnings[EARLY + frames]];
  const shown = beginnings.slice(1, 1 + frames);
  writeFileSync('picture', Buffer.concat(shown.map(({ picture }) => picture)));
  writeFileSync('profile', chip.profile.toString());
  report('frames', frames);
  report('instructions', (last.instructions - first.instructions) / frames);
  report('cycles', last.cycles - first.cycles);
  report('clock_hz', chip.clockHz);
  report('spi_hz', panel.clockHz);
  report('spi_nanoseconds', (last.sending - first.sending) / frames);
  report('stack_bytes', stack.used);
  const { lit, shown: complete } = panel.first;
  report('first_picture_nanoseconds', ((complete - lit) / chip.clockHz) * 1e9);
}

function report(name, value) {
  console.log(`${name} ${Math.round(value).toString(16)}`);
}

try {
  const [file, frames] = process.argv.slice(2);
  run(new Program(file), Number(frames));
  console.log('done');
} catch (error) {
  console.log(`fault ${error.message}`);
  console.error(error.stack);
  process.exitCode = 1;
}
