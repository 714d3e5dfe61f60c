"""Print kernels/sources/noise_table.clh: the tables of Perlin's reference noise of 2002, packed.

    python3 noise_table.py > ../../kernels/sources/noise_table.clh

The algorithm hashes the corners of a cell by p[p[p[x] + y] + z] and chooses one of twelve gradients, four of them
twice, by the low four bits of the last hash. Corners come in neighbouring pairs, so wr_perlin_hash holds p[i] and
p[i + 1] in one ushort, wr_perlin_choice the low four bits of both in one byte, those of i and i + 128 in a ushort, and
wr_perlin_gradient the gradient of p[i] in one uint: three components of 9 bits, which are the sign and the exponent of
the floats -1, 0 and 1; pairs of it are read from any i, hence its length.
"""

PERMUTATION = [
    151, 160, 137,  91,  90,  15, 131,  13, 201,  95,  96,  53, 194, 233,   7, 225,
    140,  36, 103,  30,  69, 142,   8,  99,  37, 240,  21,  10,  23, 190,   6, 148,
    247, 120, 234,  75,   0,  26, 197,  62,  94, 252, 219, 203, 117,  35,  11,  32,
     57, 177,  33,  88, 237, 149,  56,  87, 174,  20, 125, 136, 171, 168,  68, 175,
     74, 165,  71, 134, 139,  48,  27, 166,  77, 146, 158, 231,  83, 111, 229, 122,
     60, 211, 133, 230, 220, 105,  92,  41,  55,  46, 245,  40, 244, 102, 143,  54,
     65,  25,  63, 161,   1, 216,  80,  73, 209,  76, 132, 187, 208,  89,  18, 169,
    200, 196, 135, 130, 116, 188, 159,  86, 164, 100, 109, 198, 173, 186,   3,  64,
     52, 217, 226, 250, 124, 123,   5, 202,  38, 147, 118, 126, 255,  82,  85, 212,
    207, 206,  59, 227,  47,  16,  58,  17, 182, 189,  28,  42, 223, 183, 170, 213,
    119, 248, 152,   2,  44, 154, 163,  70, 221, 153, 101, 155, 167,  43, 172,   9,
    129,  22,  39, 253,  19,  98, 108, 110,  79, 113, 224, 232, 178, 185, 112, 104,
    218, 246,  97, 228, 251,  34, 242, 193, 238, 210, 144,  12, 191, 179, 162, 241,
     81,  51, 145, 235, 249,  14, 239, 107,  49, 192, 214,  31, 181, 199, 106, 157,
    184,  84, 204, 176, 115, 121,  50,  45, 127,   4, 150, 254, 138, 236, 205,  93,
    222, 114,  67,  29,  24,  72, 243, 141, 128, 195,  78,  66, 215,  61, 156, 180,
]

HASH_HEADER = """\
// Tables of Perlin's 2002 reference noise, packed so that the eight corners of a cell need 7 loads instead of 14 for
// the hashes, and no arithmetic to choose gradients. data/make/noise_table.py prints this file.
#ifndef WR_SOURCES_NOISE_TABLE_CLH
#define WR_SOURCES_NOISE_TABLE_CLH

// p[i] in the low byte, p[i + 1] in the high one.
constant ushort wr_perlin_hash[256] = {"""

CHOICE_HEADER = """\
};

// The low four bits of p[i] and p[i + 1]; in the high byte, of p[i + 128] and p[i + 129].
constant ushort wr_perlin_choice[128] = {"""

DIRECTIONS_HEADER = """\
};

// The 16 gradients: components -1, 0 or 1, each as the top 9 bits of its float, x first."""

GRADIENT_HEADER = """\

// The gradient of hash p[i], by the low four bits of it.
constant uint wr_perlin_gradient[257] = {"""

TOP_BITS = {0: 0x000, 1: 0x07F, -1: 0x17F}  # sign and exponent of 0.0f, 1.0f and -1.0f


def gradient(h):
    """The vector whose dot product with (x, y, z) is the reference's grad(h, x, y, z)."""
    h &= 15
    u = 0 if h < 8 else 1
    v = 1 if h < 4 else 0 if h in (12, 14) else 2
    g = [0, 0, 0]
    g[u] += -1 if h & 1 else 1
    g[v] += -1 if h & 2 else 1
    return g


def packed(g):
    return TOP_BITS[g[0]] << 23 | TOP_BITS[g[1]] << 14 | TOP_BITS[g[2]] << 5


def print_rows(cells, per_row):
    for i in range(0, len(cells), per_row):
        print("    " + ", ".join(cells[i:i + per_row]) + ",")


p = PERMUTATION + PERMUTATION[:1]
print(HASH_HEADER)
print_rows([f"{p[i] | p[i + 1] << 8:5d}" for i in range(256)], 16)
choice = [p[i] & 15 | (p[i + 1] & 15) << 4 for i in range(256)]
print(CHOICE_HEADER)
print_rows([f"{choice[i] | choice[i + 128] << 8:5d}" for i in range(128)], 16)
print(DIRECTIONS_HEADER)
for h in range(16):
    print(f"#define WR_PERLIN_G{h:X} 0x{packed(gradient(h)):08x}")
print(GRADIENT_HEADER)
print_rows([f"WR_PERLIN_G{h & 15:X}" for h in p], 8)
print("};")
print("\n#endif")
