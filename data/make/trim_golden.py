"""Copy a sample of the full golden tables, small enough to live in a repository.

    python3 trim_golden.py FULL FOLDER          reads FULL/*.csv, writes FOLDER/*.csv

Of every (set, category) COUNTS[set] rows are kept, spread evenly over the table, or all where there are fewer; a table
without sets counts as one category. Lines are copied as they are, so numbers stay exactly as printed and `case` is
the row's number in the full table. Listing 16 keeps the rows of TEXTURES, the small ones (16x16, 20x12, 1x8, with all
their mips). Tables of meshes keep FACES faces with all their corners. Every category of the full table must remain, or it stops.
"""
import sys
from collections import defaultdict
from pathlib import Path

COUNTS = {"regular": 16, "hard": 6, "": 48}
TEXTURES = ("0", "2", "3")
FACES = 40
TABLES = """listing01_resolve listing02_tspace_to_deriv listing03_surfgrad_tbn listing04_genbasis_tb
            listing05_perturbed_normal listing06_scale_dependent listing08_volume_gradient listing09_prologue
            listing10_screenderiv_noddxy listing11_project_vec_to_tex listing12_tex_offs_to_surface
            listing13_triplanar listing14_triplanar_weights listing15_decal
            listing16_deriv_from_heightmap listing16_textures perlin2002_demo_dnoise perlin2002_java_reference
            mikktspace_torus_degenerate_tris mikktspace_torus_mirrored_uv_tris mikktspace_torus_quads
            psrdnoise3_glsl""".split()

full, folder = map(Path, sys.argv[1:])


def spread(lines, count):
    """`count` of the lines, the first and the last among them."""
    if len(lines) <= count:
        return lines
    return [lines[round(i * (len(lines) - 1) / (count - 1))] for i in range(count)]


def trimmed(columns, lines):
    """The lines kept, in their order, and the categories found."""
    def cell(line, column):
        return line.split(",")[columns.index(column)] if column in columns else ""

    groups = defaultdict(list)
    for line in lines:
        groups[cell(line, "set"), cell(line, "category")].append(line)
    kept = set()
    for (kind, _), group in groups.items():
        if "face" in columns:
            faces = spread(list(dict.fromkeys(cell(line, "face") for line in group)), FACES)
            group = [line for line in group if cell(line, "face") in faces]
        if "tex" in columns:
            group = [line for line in group if cell(line, "tex") in TEXTURES]
        kept.update(spread(group, COUNTS[kind]) if "case" in columns else group)
    result = [line for line in lines if line in kept]
    lost = set(groups) - {(cell(line, "set"), cell(line, "category")) for line in result}
    if lost:
        sys.exit(f"no row left of {lost}")
    if "tex" in columns and {cell(line, "tex") for line in result} != set(TEXTURES):
        sys.exit("a kept texture has no rows")
    return result, len(groups)


folder.mkdir(parents=True, exist_ok=True)
for name in TABLES:
    header, *lines = (full / f"{name}.csv").read_text(encoding="ascii").splitlines()
    kept, groups = trimmed(header.split(","), lines)
    text = "\n".join([header, *kept]) + "\n"
    (folder / f"{name}.csv").write_text(text, encoding="ascii", newline="\n")
    print(f"{name}: {len(kept)} of {len(lines)} rows, {groups} categories, {len(text)} bytes")
