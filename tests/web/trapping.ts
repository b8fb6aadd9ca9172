/** Makes a wasm module in which one function only traps, as the browser sees it at a panic, or when memory runs out. */

const IMPORTS = 2;
const EXPORTS = 7;
const CODE = 10;
const FUNCTION = 0;
const UNREACHABLE = 0x00;

/** Reads the binary format of WebAssembly (core specification, chapter 5), beginning at a place. */
class Reader {
  readonly bytes: Uint8Array;
  at: number;

  constructor(bytes: Uint8Array, at: number) {
    this.bytes = bytes;
    this.at = at;
  }

  byte(): number {
    return this.bytes[this.at++] ?? 0;
  }

  /** Reads an integer in LEB128. */
  count(): number {
    let [value, shift] = [0, 0];
    for (;;) {
      const byte = this.byte();
      value += (byte & 0x7f) * 2 ** shift;
      shift += 7;
      if (byte < 0x80) {
        return value;
      }
    }
  }

  name(): string {
    const length = this.count();
    this.at += length;
    return new TextDecoder().decode(this.bytes.subarray(this.at - length, this.at));
  }
}

/** A reader at the beginning of a section's content. */
function section(bytes: Uint8Array, wanted: number): Reader {
  const reader = new Reader(bytes, 8);
  while (reader.at < bytes.length) {
    const id = reader.byte();
    const size = reader.count();
    if (id === wanted) {
      return reader;
    }
    reader.at += size;
  }
  throw new Error(`the module has no section ${wanted}`);
}

/** The index of an exported function. */
function exported(bytes: Uint8Array, wanted: string): number {
  const reader = section(bytes, EXPORTS);
  for (let left = reader.count(); left > 0; left--) {
    const name = reader.name();
    const kind = reader.byte();
    const index = reader.count();
    if (name === wanted && kind === FUNCTION) {
      return index;
    }
  }
  throw new Error(`the module exports no function ${wanted}`);
}

/** The module with the named function replaced by one that traps at once. */
export function trapping(module: Uint8Array, name: string): Buffer {
  const bytes = Uint8Array.from(module);
  // A module for browsers imports only functions.
  const imported = section(bytes, IMPORTS).count();
  const code = section(bytes, CODE);
  code.count();
  for (let left = exported(bytes, name) - imported; left > 0; left--) {
    const size = code.count();
    code.at += size;
  }
  const size = code.count();
  const end = code.at + size;
  // The groups of local variables stay; of the instructions only the last one, `end`, stays.
  for (let groups = code.count(); groups > 0; groups--) {
    code.count();
    code.byte();
  }
  bytes.fill(UNREACHABLE, code.at, end - 1);
  return Buffer.from(bytes);
}
