"""Cuts STIX Two Math down to what theory.html writes, with the table MATH, by which brackets and roots grow.

usage: python3 subset.py stix-two-math-latin-400-normal.woff2 STIXTwoMath.woff2
"""

import sys

from fontTools import subset
from fontTools.ttLib import TTFont

# Letters and figures, Greek, and the letters of mathematics: bold, italic, bold italic, sans-serif.
UNICODES = [
    *range(0x20, 0x7F),
    *range(0x391, 0x3CA),
    0x3D1, 0x3D5, 0x3F5,
    *range(0x1D400, 0x1D49C),
    *range(0x1D5A0, 0x1D5D4),
    *range(0x1D6A8, 0x1D756),
    *range(0x1D7CE, 0x1D7D8),
]
SIGNS = "·×±−∇∂∫∑√≈≠≤≥→∞′‖∥|˙~¯‾ˆ^∧˜…⋯⋮⟨⟩()[]{}⌊⌋ℎ∈∝∼\u0302\u0303\u0304\u0305\u0307\u2061\u200b\u00a0"

source, target = sys.argv[1:]
font = TTFont(source)
options = subset.Options()
options.layout_features = ["ssty", "dtls", "flac", "mark", "mkmk", "ccmp"]
options.hinting = False
options.flavor = "woff2"
options.name_IDs = [0, 1, 2, 3, 4, 5, 6, 13, 14]
subsetter = subset.Subsetter(options)
subsetter.populate(unicodes=[*UNICODES, *map(ord, SIGNS)])
subsetter.subset(font)
font.flavor = "woff2"
font.save(target)
