# SPDX-License-Identifier: LGPL-2.1-or-later
"""Finds definitions of functions in C++ sources, and pieces of their code, by matching brackets.

No compiler: what counts is the words before an opening brace. That is enough for code that clang-format has laid out or
not; macros that open or close braces are not understood."""
import bisect
import collections
import re

# One definition: where it is, its name with namespaces and classes (unnamed ones left out), and the part of the text
# from the end of its parameters, so with the initialisers of a constructor, to its closing brace.
Definition = collections.namedtuple("Definition", "file name begin end")

NOT_CODE = re.compile(
    r'''(?P<raw>R"(?P<mark>[^(\s]*)\(.*?\)(?P=mark)")|//(?:\\\n|[^\n])*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"'''
    r"""|(?<![0-9a-fA-F])'(?:\\.|[^'\\\n])+'|^[ \t]*\#(?:\\\n|[^\n])*""", re.DOTALL | re.MULTILINE)
TOKEN = re.compile(r"(?:\.?\d)(?:[eEpP][+-]|['.\w])*|\w+|::|->\*?|<<=|>>=|\+\+|--|[-+*/%^&|!<>=]=|&&|\|\||<<|\S")
CLOSING = {"(": ")", "[": "]", "{": "}"}


def code_of(text):
    """The text with comments, directives of the preprocessor and what is inside of quotes blank, as long as before."""
    def blank(match):
        piece = match.group()
        spaces = re.sub(r"[^\n]", " ", piece)
        return '"' + spaces[1:-1] + '"' if piece[0] in "\"'R" and len(piece) > 1 else spaces
    return NOT_CODE.sub(blank, text)


class Reader:
    """The tokens of one file, with the way from each bracket to the one that closes it."""

    def __init__(self, file, text):
        self.file = file
        found = list(TOKEN.finditer(code_of(text)))
        self.tokens = [match.group() for match in found]
        self.places = [match.start() for match in found]
        self.partner = {}
        opened = []
        for i, token in enumerate(self.tokens):
            if token in CLOSING:
                opened.append(i)
            elif token in CLOSING.values():
                if not opened or CLOSING[self.tokens[opened[-1]]] != token:
                    raise ValueError(f"{file}: the brackets do not match at {token} of character {self.places[i]}")
                self.partner[opened.pop()] = i
        if opened:
            raise ValueError(f"{file}: a bracket is never closed, from character {self.places[opened[-1]]}")

    def after_template(self, i, end):
        """The token after the <...> that opens at token i, in a head of a declaration."""
        depth = 0
        while i < end:
            token = self.tokens[i]
            if token in ("(", "[", "{"):
                i = self.partner[i]
            depth += (token == "<") - (token == ">")
            i += 1
            if depth == 0:
                return i
        return end

    def parameters(self, begin, end):
        """The name before the parameters in the head of a function, and the token of their ( ; or None."""
        name, i = [], begin
        while i < end:
            token = self.tokens[i]
            if token == "operator":
                # All that stands before the parameters is part of the name; operator() has brackets twice.
                opens = i + 1
                while opens < end and self.tokens[opens] != "(":
                    opens += 1
                if opens == i + 1:
                    opens += 2
                between = "" if re.match(r"\W", self.tokens[i + 1]) else " "
                word = "operator" + between + "".join(self.tokens[i + 1:opens])
                name = name if name and name[-1] == "::" else []
                return (name + [word], opens) if opens < end else None
            if token in ("decltype", "alignas", "noexcept", "__attribute__") and i + 1 < end \
                    and self.tokens[i + 1] == "(":
                name, i = [], self.partner[i + 1]
            elif token == "(":
                return (name, i) if name else None
            elif token == "<":
                i = self.after_template(i, end) - 1
            elif token == "[":
                i = self.partner[i]
            elif token == "=":
                return None
            elif token == "::":
                name = name + ["::"]
            elif token == "~":
                name = name + ["~"]
            elif re.match(r"[^\W\d]", token):
                name = name + [token] if name and name[-1] in ("::", "~") else [token]
            else:
                name = []
            i += 1
        return None

    def class_name(self, begin, end):
        """The name of the class, struct or union in a head, an empty one of an unnamed type; None of another head."""
        i = begin
        while i < end and self.tokens[i] == "template":
            i = self.after_template(i + 1, end)
        if i >= end or self.tokens[i] not in ("class", "struct", "union"):
            return None
        name = ""
        i += 1
        while i < end and self.tokens[i] not in (":", "final"):
            if self.tokens[i] == "<":
                i = self.after_template(i, end)
                continue
            if self.tokens[i] in ("[", "("):
                i = self.partner[i]
            elif re.match(r"[^\W\d]", self.tokens[i]):
                name = name + self.tokens[i] if name.endswith("::") else self.tokens[i]
            elif self.tokens[i] == "::":
                name += "::"
            else:
                return None
            i += 1
        return name

    def definitions(self, begin=0, end=None, scope=()):
        """The functions between two tokens of a namespace or class."""
        end = len(self.tokens) if end is None else end
        head = i = begin
        while i < end:
            token = self.tokens[i]
            if token in ("(", "["):
                i = self.partner[i]
            elif token == ";" or (token == ":" and self.tokens[i - 1] in ("public", "protected", "private")):
                head = i + 1
            elif token == "{":
                close = self.partner[i]
                first = self.tokens[head] if head < i else ""
                found = None if first == "enum" else self.parameters(head, i)
                if "namespace" in self.tokens[head:min(head + 2, i)]:
                    name = tuple(t for t in self.tokens[head:i] if t not in ("inline", "namespace", "::"))
                    yield from self.definitions(i + 1, close, scope + name)
                    head = close + 1
                elif first == "extern" and set(self.tokens[head + 1:i]) == {'"'}:
                    yield from self.definitions(i + 1, close, scope)
                    head = close + 1
                elif (name := self.class_name(head, i)) is not None:
                    yield from self.definitions(i + 1, close, scope + ((name,) if name else ()))
                    # Up to the semicolon, variables may follow.
                elif found:
                    name, opens = found
                    after = self.partner[opens] + 1
                    if ":" not in self.tokens[after:i] or not re.match(r"\w|>", self.tokens[i - 1]):
                        yield Definition(self.file, "::".join(scope + ("".join(name),)), self.places[after],
                                         self.places[close] + 1)
                        head = close + 1
                    # Otherwise the braces are of one member in the list of a constructor.
                i = close
            i += 1


def definitions_of(file, text):
    """All functions that a text defines."""
    return list(Reader(file, text).definitions())


class Piece:
    """A part of a text without white space where that separates no words, with the places of its tokens."""

    def __init__(self, text, begin, end):
        self.text, self.starts, self.ends, self.places = "", [], [], []
        previous = ""
        for match in TOKEN.finditer(code_of(text)[begin:end]):
            token = match.group()
            if previous and re.match(r"\w", previous[-1]) and re.match(r"\w", token[0]):
                self.text += " "
            self.starts.append(len(self.text))
            self.text += token
            self.ends.append(len(self.text))
            self.places.append((begin + match.start(), begin + match.end()))
            previous = token

    def matches(self, pattern):
        """Where a pattern fits, from and to whole tokens: begin and end in the text, and the match."""
        found, covered = [], 0
        for first, start in enumerate(self.starts):
            match = pattern.match(self.text, start) if start >= covered else None
            if not match or match.end() == start:
                continue
            last = bisect.bisect_left(self.ends, match.end())
            if self.ends[last] == match.end():
                found.append((self.places[first][0], self.places[last][1], match))
                covered = match.end()
        return found


def pattern_of(expression):
    """A regular expression whose white space counts only between words, where a line may end as well."""
    expression = " ".join(expression.split())
    return re.compile(re.sub(r"(?<!\w) | (?!\w)", " ?", expression))
