//! Handles: the numbers by which a visibility buffer names what is seen.

/// Primitives of a mesh per chunk, at most.
const CHUNK: usize = 2048;

/// Primitives per chunk of a mesh that has so many: fewer where there are few, so that each thread has some chunks.
/// The number of threads makes no difference.
pub(super) fn per_chunk(primitives: usize) -> usize {
    (primitives / 16).next_power_of_two().clamp(CHUNK / 8, CHUNK)
}

/// Numbers of vertices and primitives fit in the index buffer's u32.
#[expect(clippy::cast_possible_truncation, reason = "as the line above says")]
pub(super) fn number(i: usize) -> u32 {
    i as u32
}

/// Bits of the index of a primitive in its chunk.
const INDEX_BITS: u32 = 14;

// A chunk must have room for all that clipping makes: of a triangle at most 7.
const _: () = assert!(7 * CHUNK < 1 << INDEX_BITS);

/// The number of a primitive among those of all chunks, plus one: 0 is nothing.
pub(super) type Handle = u32;

/// The handle of primitive `index` of chunk `chunk`.
#[expect(
    clippy::cast_possible_truncation,
    reason = "the largest scene has fewer than 2^18 chunks (scene::checks)"
)]
pub(super) fn pack(chunk: usize, index: u32) -> Handle {
    ((chunk as u32) << INDEX_BITS) + index + 1
}

/// The chunk and index of a handle other than 0.
pub(super) fn unpack(handle: Handle) -> (usize, usize) {
    let number = handle - 1;
    ((number >> INDEX_BITS) as usize, (number & ((1 << INDEX_BITS) - 1)) as usize)
}
