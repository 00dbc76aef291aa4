//! Recognizes instructions that load or store (Arm, "ARMv7-M Architecture Reference Manual", A5; RISC-V, "The
//! RISC-V Instruction Set Manual", volume I, chapters 24 and 26).

use object::Architecture;

/// Whether the instruction at the beginning of these bytes loads or stores.
pub(super) fn touches_memory(architecture: Architecture, bytes: &[u8]) -> bool {
    let (halves, _) = bytes.as_chunks::<2>();
    let half = |index: usize| halves.get(index).map_or(0, |half| u16::from_le_bytes(*half));
    match architecture {
        Architecture::Arm => thumb(half(0), half(1)),
        Architecture::Riscv32 => riscv(half(0)),
        _ => false,
    }
}

fn thumb(first: u16, second: u16) -> bool {
    match first >> 11 {
        // One register: relative to the program counter, a register, an immediate or the stack pointer.
        // Several registers.
        0b01001 | 0b01010..=0b10011 | 0b11000 | 0b11001 => true,
        // Push and pop.
        0b10110 | 0b10111 => first & 0x0600 == 0x0400,
        // Several registers, two, or exclusive access; FPU loads and stores, but not moves between FPU and
        // processor.
        0b11101 => match first & 0x0600 {
            0 => true,
            0x0400 => first & 0x03A0 != 0 && second & 0x0E00 == 0x0A00,
            _ => false,
        },
        // One register, in 32 bits.
        0b11111 => first & 0x0600 == 0,
        _ => false,
    }
}

fn riscv(half: u16) -> bool {
    let function = half >> 13;
    match half & 3 {
        0 => function != 0,
        1 => false,
        2 => !matches!(function, 0 | 4),
        // Loads, stores and atomics.
        _ => matches!(half & 0x7F, 0x03 | 0x07 | 0x23 | 0x27 | 0x2F),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thumb_instructions() {
        let accesses = [
            (0x4801, 0),      // ldr r0, [pc, #4]
            (0x5888, 0),      // ldr r0, [r1, r2]
            (0x6008, 0),      // str r0, [r1]
            (0x9801, 0),      // ldr r0, [sp, #4]
            (0xB510, 0),      // push {r4, lr}
            (0xBD10, 0),      // pop {r4, pc}
            (0xC903, 0),      // ldm r1!, {r0, r1}
            (0xE92D, 0x4FF0), // push.w {r4-r11, lr}
            (0xE9D1, 0x2300), // ldrd r2, r3, [r1]
            (0xED91, 0x0A00), // vldr s0, [r1]
            (0xED2D, 0x8B10), // vpush {d8-d15}
            (0xF8D1, 0x0100), // ldr.w r0, [r1, #256]
        ];
        for (first, second) in accesses {
            assert!(thumb(first, second), "{first:04x} {second:04x}");
        }
        let others = [
            (0x1888, 0),      // adds r0, r1, r2
            (0x4288, 0),      // cmp r0, r1
            (0x4770, 0),      // bx lr
            (0xA801, 0),      // add r0, sp, #4
            (0xB082, 0),      // sub sp, #8
            (0xB108, 0),      // cbz r0
            (0xBF00, 0),      // nop
            (0xD001, 0),      // beq
            (0xEA40, 0x0001), // orr.w
            (0xEE30, 0x0A20), // vadd.f32
            (0xEEB1, 0x0AC0), // vsqrt.f32
            (0xEC51, 0x0B10), // vmov r0, r1, d0
            (0xF000, 0xF800), // bl
            (0xFB01, 0xF000), // mul
        ];
        for (first, second) in others {
            assert!(!thumb(first, second), "{first:04x} {second:04x}");
        }
    }

    #[test]
    fn riscv_instructions() {
        // lw, sw, c.lw, c.swsp, c.lwsp, flw.
        for access in [0x2503, 0x2023, 0x4188, 0xC02A, 0x4502, 0x2507] {
            assert!(riscv(access), "{access:04x}");
        }
        // addi, c.addi4spn, c.li, c.slli, c.mv, mul.
        for other in [0x0513, 0x0808, 0x4501, 0x0506, 0x852E, 0x0533] {
            assert!(!riscv(other), "{other:04x}");
        }
    }
}
