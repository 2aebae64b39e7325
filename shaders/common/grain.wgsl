// Random words of grains of sand: pure functions of (key, cell) in u32 arithmetic alone, so that a seed gives the same
// desert on every device. Twins: tyndall_dunes::hash.

/// A bijection of u32 whose every output bit depends on every input bit.
fn grain_mix(word: u32) -> u32 {
    var x = word;
    x ^= x >> 16u;
    x *= 0x7FEB352Du;
    x ^= x >> 15u;
    x *= 0x846CA68Bu;
    return x ^ (x >> 16u);
}

/// Word of a cell under the key of a step.
fn grain_cell_word(key: u32, cell: u32) -> u32 {
    return grain_mix((cell * 0x9E3779B9u) ^ key);
}

/// The word after `word` of the same grain.
fn grain_next_word(word: u32) -> u32 {
    return grain_mix(word + 0x632BE5ABu);
}
