# SPDX-License-Identifier: LGPL-2.1-or-later
"""Which functions a text defines and where patterns fit in them, for code with all that definitions.py has to know."""
import sys

sys.dont_write_bytecode = True
import definitions

# Each function returns a number of its own, so that its part of the text is known.
CODE = r'''
#define OPEN {
// A comment with { and "
namespace a::b
{
  namespace
  {
    constexpr double limits[] = {1., 2.}; /* } */
    double helper(const double x) { return 1; }
    struct Local { int k = 0; int call() { return 2; } };
  }
  enum class Kind { one, two };
  extern "C" { int foreign() { return 3; } }

  template <typename T, int n = (2 > 1)>
  class Holder : public Base<T>
  {
  public:
    Holder(int i) : Base<T>{i}, list{1, 2}, text("}") { return 4; }
    ~Holder() { return 5; }
    double operator()(int i) const { return 6; }
    Holder &operator+=(const Holder &h) noexcept { return 7; }
    operator bool() const { return 8; }
    auto late(std::function<void(int)> f = {}) -> std::vector<T> override { return 9; }
    struct Inner { static void put(char c = '{'); };
    [[nodiscard]] int declared_only() const;
    int value{3};
  } instance;

  template <typename T, int n>
  void Holder<T, n>::Inner::put(const char c)
  {
    const auto act = [&](int i) { if (i > 0) { return 10; } return 0; };
    const char *s = "}", *raw = R"x( } )" )x", q = '"', digits = 1'000;
    act(1);
  }
  std::map<int, std::pair<int, int>> table(int i) { return 11; }
  bool operator==(const Kind &x, const Kind &y) { return 12; }
  double helper(int i, int j) { return 13; }
}
int main(int argc, char **argv) try_it { return 14; }
'''
NAMES = {1: "a::b::helper", 2: "a::b::Local::call", 3: "a::b::foreign", 4: "a::b::Holder::Holder",
         5: "a::b::Holder::~Holder", 6: "a::b::Holder::operator()", 7: "a::b::Holder::operator+=",
         8: "a::b::Holder::operator bool", 9: "a::b::Holder::late", 10: "a::b::Holder::Inner::put", 11: "a::b::table",
         12: "a::b::operator==", 13: "a::b::helper", 14: "main"}

# A pattern, and how often it fits in the two texts below it, which are the same code in two layouts.
PATTERNS = {r"du": 1, r"2\. \* du": 1, r"2\..*?du": 1, r"return x\(u, v\)": 1, r"u": 2, r"return\s+": 0, r"- \w+ ;": 1,
            r"return \w+": 1, r"comment": 0, r"inside": 0, r"1\.": 0, r"u, v": 1, r"-": 1,
            r"[^;]* - w": 1}
LAYOUTS = ['double f() { u = 2. * du - w; du_old = 1.5; s = "inside"; return x(u, v); }',
           '''double f()
{
  u = 2. * du // comment
      -
      w;
  /* du */ du_old = 1.5;
  s = "inside";
  return
    x(
      u,
      v);
}''']

errors = []
found = definitions.definitions_of("file", CODE)
for number, name in NAMES.items():
    holding = [f.name for f in found if f"return {number};" in CODE[f.begin:f.end]]
    if holding != [name]:
        errors.append(f"return {number} is in {holding} instead of {name}")
if len(found) != len(NAMES):
    errors.append(f"{len(found)} functions instead of {len(NAMES)}")
constructor = next(f for f in found if f.name == NAMES[4])
if not CODE[constructor.begin:constructor.end].startswith(": Base"):
    errors.append("the initialisers of a constructor are missing")

for pattern, count in PATTERNS.items():
    for text in LAYOUTS:
        function, = definitions.definitions_of("file", text)
        piece = definitions.Piece(text, function.begin, function.end)
        matches = piece.matches(definitions.pattern_of(pattern))
        if len(matches) != count:
            errors.append(f"{pattern} fits {len(matches)} times instead of {count} in\n{text}")
        for begin, end, match in matches:
            if definitions.Piece(text, begin, end).text != match.group():
                errors.append(f"{pattern} has the wrong place in\n{text}")

for broken in ("int f() { return (1; }", "int f() {"):
    try:
        definitions.definitions_of("file", broken)
        errors.append(f"no error: {broken}")
    except ValueError:
        pass
sys.exit("\n".join(errors) or None)
