// The panel: an ST7789's commands of MIPI DCS that address and write pixels (Sitronix, "ST7789V", chapter 9).

const COLUMNS = 0x2a;
const ROWS = 0x2b;
const WRITE = 0x2c;
const ADDRESS_MODE = 0x36;
const PIXEL_FORMAT = 0x3a;

// Address mode.
const MIRROR_ROWS = 0x80;
const MIRROR_COLUMNS = 0x40;
const EXCHANGE = 0x20;

const PIXEL_16_BITS = 0x5;

const SHORT_SIDE = 240;
const LONG_SIDE = 320;

/** A panel on the chip's first SPI, turned so that the picture is upright. */
export class Panel {
  constructor(chip, pins) {
    this.chip = chip;
    this.pins = pins;
    this.spi = chip.mcu.spi[0];
    /** Called when a frame begins, once the backlight is on. */
    this.onFrame = () => {};
    /** The cycles at which the backlight goes on, and at which the first picture is whole from then on. */
    this.first = { lit: undefined, shown: undefined };
    chip.mcu.gpio[pins.backlight].addListener(() => {
      if (chip.isHigh(pins.backlight)) this.first.lit ??= chip.count.cycles;
    });
    /** Time that the bus has been busy. */
    this.nanoseconds = 0;
    this.command = 0;
    this.parameters = [];
    this.mode = 0;
    // The memory's content is undefined when the panel is turned on.
    this.memory = Buffer.alloc(2 * SHORT_SIDE * LONG_SIDE, 0x5a);
    this.columns = [0, SHORT_SIDE - 1];
    this.rows = [0, LONG_SIDE - 1];
    const sent = chip.mcu.clock.createAlarm(() => this.spi.completeTransmit(0));
    this.spi.onTransmit = (byte) => {
      const nanoseconds = (this.spi.dataBits * 1e9) / this.clockHz;
      this.nanoseconds += nanoseconds;
      if (!chip.isHigh(pins.select)) this.#receive(byte);
      sent.schedule(nanoseconds);
    };
  }

  /** The clock of the bus. */
  get clockHz() {
    return this.spi.clockFrequency;
  }

  get #width() {
    return this.mode & EXCHANGE ? LONG_SIDE : SHORT_SIDE;
  }

  /** The panel's pixels, line by line: RGB565, the low byte first. */
  picture() {
    return Buffer.from(this.memory).swap16();
  }

  #receive(byte) {
    if (this.chip.isHigh(this.pins.data)) {
      this.parameters.push(byte);
      this.#data();
    } else {
      this.command = byte;
      this.parameters = [];
      if (byte === WRITE) {
        [this.x] = this.columns;
        [this.y] = this.rows;
        if (this.chip.isHigh(this.pins.backlight)) this.onFrame();
      }
    }
  }

  #data() {
    const { command, parameters } = this;
    if (command === WRITE && parameters.length === 2) {
      this.#pixel(parameters);
      this.parameters = [];
    } else if ((command === COLUMNS || command === ROWS) && parameters.length === 4) {
      const range = [parameters[0] * 256 + parameters[1], parameters[2] * 256 + parameters[3]];
      if (command === COLUMNS) this.columns = range;
      else this.rows = range;
    } else if (command === ADDRESS_MODE) {
      [this.mode] = parameters;
      const flips = [MIRROR_ROWS, MIRROR_COLUMNS, EXCHANGE].filter((bit) => this.mode & bit);
      if (flips.length % 2 === 1) throw new Error('the panel shows a mirror image: change its orientation');
    } else if (command === PIXEL_FORMAT && (parameters[0] & 7) !== PIXEL_16_BITS) {
      throw new Error('the panel must be set to 16 bits per pixel');
    }
  }

  /** Stores a pixel and moves to the next place of the window. */
  #pixel(bytes) {
    const width = this.#width;
    if (this.x < width && this.y * width + this.x < this.memory.length / 2) {
      this.memory.set(bytes, 2 * (this.y * width + this.x));
    }
    if (this.x++ === this.columns[1]) {
      [this.x] = this.columns;
      if (this.y++ === this.rows[1]) {
        [this.y] = this.rows;
        if (this.first.lit !== undefined) this.first.shown ??= this.chip.count.cycles;
      }
    }
  }
}
