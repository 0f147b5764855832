"""Writes special.in: reference values of src/model/special.rs from mpmath at 50 digits."""
from mpmath import mp, mpf, sin, cos
mp.dps = 50
rows = []
for text in ["1e-12", "1e-8", "1e-5", "1e-4", "0.001", "0.01", "0.1", "0.3", "0.5", "0.9", "0.99999",
             "0.9999999999999999", "1.0", "1.0000000000000002", "1.1", "1.6", "2", "3", "3.1", "4", "5.5", "6.2"]:
    x = mpf(float(text))
    values = [sin(x) / x, (1 - cos(x)) / x**2, (x * sin(x) - (1 - cos(x))) / x**2, (sin(x) - x * cos(x)) / x**2]
    rows.append("    (%r, %s),\n" % (float(text), ", ".join(repr(float(v)) for v in values)))
with open(__file__.replace(".py", ".in"), "w") as out:
    out.write("[\n" + "".join(rows) + "]\n")
