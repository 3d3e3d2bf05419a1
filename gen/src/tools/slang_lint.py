"""Lints Verilog files with slang (pyslang): slang_lint.py TOP[,TOP]... FILE...

Everything slang knows is a warning here and every warning fails, except:
  unused-net          Verilator decides what is unused; it knows `_unused_ok` by its name, slang does not
  sign-conversion     `wire [7:0] y = $signed(a) >>> n;` keeps every bit: signed operators have a net of their own
  arith-op-mismatch   `$signed(a) * $signed(b)` of two widths extends both signs, as a signed product should
"""

import sys

from pyslang.driver import Driver

ALLOWED = ["unused-net", "sign-conversion", "arith-op-mismatch"]

tops, files = sys.argv[1].split(","), sys.argv[2:]
flags = ["-Weverything", "-DTILEWRIGHT_MODELS"] + ["-Wno-" + name for name in ALLOWED]
driver = Driver()
driver.addStandardArgs()
ok = driver.parseCommandLine(" ".join(["slang", "-Werror"] + ["--top=" + top for top in tops] + flags + files))
ok = ok and driver.processOptions() and driver.parseAllSources()
if ok:
    compilation = driver.createCompilation()
    driver.reportCompilation(compilation, True)
    driver.runAnalysis(compilation)
    ok = driver.reportDiagnostics(True)
sys.exit(0 if ok else 1)
