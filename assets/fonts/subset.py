"""Cuts one weight of Inter down to what the page writes, with tabular figures made the default.

usage: python3 subset.py Inter-Regular.otf out.otf
"""

import sys

from fontTools import subset
from fontTools.ttLib import TTFont

# Latin with accents, Greek, and the signs of the page.
UNICODES = [*range(0x20, 0x7F), *range(0xA0, 0x180), *range(0x370, 0x3D7)]
SIGNS = "‐‑–—‘’“”„•…‰′″‖₀₁₂₃₄₅₆₇₈₉⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻₊₋€←↑→↓↔−∞≈≠≤≥×÷·√∂∆∑∫▲▼◀▶●○◆◇■□✓\u2009\u200a\u202f"

source, target = sys.argv[1:]
font = TTFont(source)

# egui applies no optional OpenType features, so `tnum` is put into the character map.
tabular = {}
for record in font["GSUB"].table.FeatureList.FeatureRecord:
    if record.FeatureTag == "tnum":
        for index in record.Feature.LookupListIndex:
            for table in font["GSUB"].table.LookupList.Lookup[index].SubTable:
                table = getattr(table, "ExtSubTable", table)
                tabular.update(getattr(table, "mapping", {}))
for table in font["cmap"].tables:
    for code, glyph in table.cmap.items():
        if chr(code) in "0123456789+−.,:":
            table.cmap[code] = tabular.get(glyph, glyph)

options = subset.Options()
options.layout_features = ["kern", "mark", "mkmk", "ccmp", "locl"]
options.hinting = False
options.desubroutinize = False
options.name_IDs = [0, 1, 2, 3, 4, 5, 6, 13, 14]
options.notdef_outline = True
subsetter = subset.Subsetter(options)
subsetter.populate(unicodes=[*UNICODES, *map(ord, SIGNS)])
subsetter.subset(font)
# In the heavier weight one figure is rounded to another width than the rest.
metrics, names = font["hmtx"].metrics, font.getBestCmap()
for figure in "123456789":
    metrics[names[ord(figure)]] = (metrics[names[ord("0")]][0], metrics[names[ord(figure)]][1])
font.save(target)
missing = [c for c in SIGNS if ord(c) not in font.getBestCmap()]
print(target, "lacks", " ".join(missing) or "nothing")
