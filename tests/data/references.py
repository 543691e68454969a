#!/usr/bin/env python3
"""High-precision reference solutions of the described mechanisms.

*Dimensions, typed here once more* -> *tests/data/<mechanism>.csv*: t = 0, 0.5, ..., 5; q, q', q'' with 25 digits.

    python3 tests/data/references.py             write all tables
    python3 tests/data/references.py four_bar    write one
    python3 tests/data/references.py --check     compare with the committed tables instead of writing

Nothing of Linkwright is used. A mechanism is written as pins: some are given, the others are unknown and satisfy equations
between points, |PQ|^2 = l^2 or "on a line", which are polynomials of degree two at most. Poses of bodies follow from two of
their pins. The equations are solved for Taylor polynomials in t of degree two (jets): Newton's iteration on jets gives
position, velocity and acceleration at once and exactly, without a derivative written by hand and without differences.
Continuation from the drawing in small steps keeps the assembly mode and counts full turns of angles.

Needs mpmath. All numbers have 60 digits; residuals of all three levels must be below 1e-50.
"""

import sys
from pathlib import Path

from mpmath import matrix, mp, mpf, lu_solve

mp.dps = 60
RESIDUAL = mpf(10) ** -50
STEPS_PER_SECOND = 50
END = 5
PER_ROW = STEPS_PER_SECOND // 2


class Jet:
    """c0 + c1 h + c2 h^2, a function of t = t0 + h up to its second derivative."""

    __slots__ = ("c",)

    def __init__(self, c0, c1=0, c2=0):
        self.c = (mpf(c0), mpf(c1), mpf(c2))

    @staticmethod
    def of(value):
        return value if isinstance(value, Jet) else Jet(value)

    def __add__(self, other):
        return Jet(*(a + b for a, b in zip(self.c, Jet.of(other).c)))

    __radd__ = __add__

    def __neg__(self):
        return Jet(*(-a for a in self.c))

    def __sub__(self, other):
        return self + -Jet.of(other)

    def __rsub__(self, other):
        return Jet.of(other) + -self

    def __mul__(self, other):
        (a0, a1, a2), (b0, b1, b2) = self.c, Jet.of(other).c
        return Jet(a0 * b0, a0 * b1 + a1 * b0, a0 * b2 + a1 * b1 + a2 * b0)

    __rmul__ = __mul__

    def __truediv__(self, other):
        return self * Jet.of(other).compose(lambda x: (1 / x, -1 / x**2, 2 / x**3))

    def __rtruediv__(self, other):
        return Jet.of(other) / self

    def compose(self, function):
        """f(self), with `function` giving f, f', f'' at a number."""
        c0, c1, c2 = self.c
        f0, f1, f2 = function(c0)
        return Jet(f0, f1 * c1, f1 * c2 + f2 * c1**2 / 2)


def sin(x):
    return Jet.of(x).compose(lambda v: (mp.sin(v), mp.cos(v), -mp.sin(v)))


def cos(x):
    return Jet.of(x).compose(lambda v: (mp.cos(v), -mp.sin(v), -mp.cos(v)))


def sqrt(x):
    return Jet.of(x).compose(lambda v: (mp.sqrt(v), 1 / (2 * mp.sqrt(v)), -1 / (4 * mp.sqrt(v) ** 3)))


def atan2(y, x):
    """The angle of (x, y) between -pi and pi, from the derivative of the angle: (x dy - y dx) / (x^2 + y^2)."""
    y, x = Jet.of(y), Jet.of(x)
    dx, dy = Jet(x.c[1], 2 * x.c[2]), Jet(y.c[1], 2 * y.c[2])
    rate = (x * dy - y * dx) / (x * x + y * y)
    return Jet(mp.atan2(y.c[0], x.c[0]), rate.c[0], rate.c[1] / 2)


class Point:
    """A pair of jets."""

    __slots__ = ("x", "y")

    def __init__(self, x, y):
        self.x, self.y = Jet.of(x), Jet.of(y)

    def __add__(self, other):
        return Point(self.x + other.x, self.y + other.y)

    def __sub__(self, other):
        return Point(self.x - other.x, self.y - other.y)

    def scaled(self, factor):
        return Point(factor * self.x, factor * self.y)

    def turned(self, cosine, sine):
        return Point(cosine * self.x - sine * self.y, sine * self.x + cosine * self.y)


def dot(a, b):
    return a.x * b.x + a.y * b.y


def cross(a, b):
    return a.x * b.y - a.y * b.x


def exact(text):
    """A number written in decimals, as exactly that."""
    return mpf(text)


def points(text):
    """`A -1 0.2, B ...` as named points."""
    table = {}
    for entry in text.split(","):
        name, x, y = entry.split()
        table[name] = Point(exact(x), exact(y))
    return table


def distance(a, b):
    difference = a - b
    return sqrt(dot(difference, difference))


def apart(a, b, length):
    """|AB|^2 - l^2 for the length or, if it is a pair, the distance of two points as drawn."""
    squared = dot(length[0] - length[1], length[0] - length[1]) if isinstance(length, tuple) else length * length
    return dot(a - b, a - b) - squared


def carried(drawn, now, base, tip, name):
    """Where a point of the rigid body with the pins `base` and `tip` is."""
    arm, target = drawn[tip] - drawn[base], drawn[name] - drawn[base]
    length = dot(arm, arm)
    along, across = dot(arm, target) / length, cross(arm, target) / length
    moved = now[tip] - now[base]
    return now[base] + moved.turned(along, across)


def pose(drawn_base, drawn_arm, base, arm, origin, angle=0):
    """x, y, phi of the frame drawn at `origin` with `angle`, of a body whose `drawn_arm` is now the vector `arm`.

    The arms may have different lengths: of a slide only the direction counts.
    """
    sizes = sqrt(dot(drawn_arm, drawn_arm)) * sqrt(dot(arm, arm))
    cosine, sine = dot(drawn_arm, arm) / sizes, cross(drawn_arm, arm) / sizes
    position = base + (origin - drawn_base).turned(cosine, sine)
    return [position.x, position.y, angle + atan2(sine, cosine)]


def heading(drawn, start, end):
    """The angle of the x axis of a frame that faces from one point to another."""
    arm = drawn[end] - drawn[start]
    return atan2(arm.y, arm.x)


def at(text):
    x, y = text.split()
    return Point(exact(x), exact(y))


class Mechanism:
    """Names of bodies, unknowns as drawn, equations F(unknowns, t) of degree two at most, and poses.

    `contacts` names coordinates after those of the bodies: the angles at which curves are touched.
    """

    def __init__(self, bodies, start, equations, poses, contacts=()):
        self.bodies, self.start, self.equations, self.poses = bodies, start, equations, poses
        self.contacts = contacts

    def coordinates(self):
        axes = ("x", "y", "phi")
        return [f"{axis}{body}" for body in self.bodies for axis in axes] + [name.replace("_", "", 1) for name in self.contacts]

    def angles(self):
        """The places of the coordinates that are angles."""
        poses = 3 * len(self.bodies)
        return list(range(2, poses, 3)) + list(range(poses, poses + len(self.contacts)))


def with_pins(bodies, drawn, unknown, place, equations, poses):
    """A mechanism whose unknowns are pins: `place(drawn, now, t)` adds the others to the table of pins."""

    def table(values, t):
        now = dict(drawn)
        for index, name in enumerate(unknown):
            now[name] = Point(values[2 * index], values[2 * index + 1])
        place(now, t)
        return now

    start = [c for name in unknown for c in (drawn[name].x.c[0], drawn[name].y.c[0])]
    return Mechanism(
        bodies,
        start,
        lambda values, t: equations(table(values, t), t),
        lambda values, t: poses(table(values, t)),
    )


def two_body():
    root = mp.sqrt(3)

    def equations(values, t):
        angle = mp.pi / 6 + sin(2 * t)
        return [apart(Point(cos(angle), sin(angle)), Point(root, values[0]), Jet(root))]

    def poses(values, t):
        angle = mp.pi / 6 + sin(2 * t)
        rod = Point(root, values[0]) - Point(cos(angle), sin(angle))
        return [Jet(0), Jet(0), angle, Jet(root), values[0], atan2(rod.y, rod.x)]

    return Mechanism(["1", "2"], [mpf(2)], equations, poses)


EXCAVATOR = "A -1 0.2, B -0.7 0.8, D -0.2 0.5, E 0.1 0.8, F 0.9 0.7, G 0.3 0.6, H 0.7 -0.4, I 0.7 0.3, J 0 0.9, L 0.6 0.3, M 0.2 0.6, N 0.4 -0.2"


def excavator(origins):
    drawn = points(EXCAVATOR)
    origins = [drawn[o] if o in drawn else at(o) for o in origins]

    def place(now, t):
        stroke = exact("0.05") * sin(exact("1.5") * t)
        now["F"] = carried(drawn, now, "L", "G", "F")
        now["I"] = carried(drawn, now, "L", "G", "I")
        now["J"] = carried(drawn, now, "F", "M", "J")
        now["E"] = carried(drawn, now, "F", "M", "E")
        now["A"] = carried(drawn, now, "I", "D", "A")
        now["HG"] = distance(drawn["H"], drawn["G"]) + stroke
        now["NM"] = distance(drawn["N"], drawn["M"]) + stroke

    def equations(p, t):
        rigid = ["LG", "FM", "ID", "DE", "AB", "BJ"]
        return [apart(p[a], p[b], (drawn[a], drawn[b])) for a, b in rigid] + [
            apart(p["H"], p["G"], p["HG"]),
            apart(p["N"], p["M"], p["NM"]),
        ]

    def poses(p):
        body = {1: "AB", 2: "FM", 3: "LG", 4: "ID", 5: "BJ", 6: "DE", 7: "MN", 8: "NM", 9: "GH", 10: "HG"}
        angles = {7: heading(drawn, "N", "M"), 8: heading(drawn, "N", "M")}
        angles |= {9: heading(drawn, "H", "G"), 10: heading(drawn, "H", "G")}
        q = []
        for number, (a, b) in body.items():
            q += pose(drawn[a], drawn[b] - drawn[a], p[a], p[b] - p[a], origins[number - 1], angles.get(number, 0))
        return q

    names = [f"c{number}" for number in range(1, 11)]
    return with_pins(names, drawn, ["G", "M", "D", "B"], place, equations, poses)


def excavator_pins():
    return excavator("AJLIBDMNGH")


def excavator_centers():
    return excavator(
        "-0.95 0.55,0.4 0.75,0.6 0.5,-0.10 0.35,-0.35 0.85,-0.05 0.65,0.25 0.4,0.35 0,0.4 0.35,0.6 -0.15".split(",")
    )


def arm():
    drawn = points(
        "A 0 0, B 0.3 0, D 0.2 0.6, E -0.1 0.7, F -0.2 0.8, G 0 1.2, H 0.5 0.8, I 0.5 -0.1, J 0.7 0.3, K 0.8 0.6, "
        "L 1 -0.5, M 1.3 -0.3, N 1.3 0"
    )
    origins = "0 0.85,0.4 0.75,0.15 0.45,0.05 0.15,0.45 0.6,0.35 0.2,0.4 0.1,0.65 0.25,1.05 0.3,1.2 -0.25".split(",")

    def place(now, t):
        now["F"] = carried(drawn, now, "E", "D", "F")
        now["G"] = carried(drawn, now, "E", "D", "G")
        now["J"] = carried(drawn, now, "G", "H", "J")
        now["L"] = carried(drawn, now, "F", "I", "L")
        now["K"] = carried(drawn, now, "J", "I", "K")
        now["AD"] = distance(drawn["A"], drawn["D"]) - (exact("0.05") - exact("0.08") * sin(mp.pi * t + mp.pi / 4))
        now["BH"] = distance(drawn["B"], drawn["H"]) - (exact("0.04") - exact("0.1") * sin(mp.pi * t / 4 - mp.pi / 3))

    def equations(p, t):
        rigid = ["ED", "GH", "FI", "JI", "KN", "LN"]
        return [apart(p[a], p[b], (drawn[a], drawn[b])) for a, b in rigid] + [
            apart(p["A"], p["D"], p["AD"]),
            apart(p["B"], p["H"], p["BH"]),
        ]

    def poses(p):
        body = ["ED", "GH", "DA", "AD", "HB", "BH", "FI", "JI", "KN", "LN"]
        q = []
        for (a, b), origin in zip(body, origins):
            q += pose(drawn[a], drawn[b] - drawn[a], p[a], p[b] - p[a], at(origin))
        return q

    names = [f"c{number}" for number in range(1, 11)]
    return with_pins(names, drawn, ["D", "H", "I", "N"], place, equations, poses)


def four_bar():
    crank, coupler, rocker, ground = (exact(v) / 1000 for v in (40, 120, 80, 100))
    base = Point(ground, 0)

    def angle(t):
        return 40 * mp.pi / 180 + 3 * t

    def tip(t):
        return Point(crank * cos(angle(t)), crank * sin(angle(t)))

    def equations(values, t):
        c = Point(*values)
        return [apart(tip(t), c, Jet(coupler)), apart(base, c, Jet(rocker))]

    def poses(values, t):
        b, c = tip(t), Point(*values)
        rod, swing = c - b, c - base
        return [Jet(0), Jet(0), angle(t), b.x, b.y, atan2(rod.y, rod.x), base.x, base.y, atan2(swing.y, swing.x)]

    return Mechanism(["crank", "coupler", "rocker"], [exact("0.143"), exact("0.067")], equations, poses)


def slider_crank():
    crank, rod, offset = (exact(v) / 1000 for v in (40, 120, -20))

    def angle(t):
        return 60 * mp.pi / 180 + 3 * t

    def tip(t):
        return Point(crank * cos(angle(t)), crank * sin(angle(t)))

    def equations(values, t):
        return [apart(tip(t), Point(values[0], offset), Jet(rod))]

    def poses(values, t):
        b, c = tip(t), Point(values[0], offset)
        line = c - b
        return [Jet(0), Jet(0), angle(t), b.x, b.y, atan2(line.y, line.x), c.x, c.y, Jet(0)]

    return Mechanism(["crank", "rod", "slider"], [exact("0.127")], equations, poses)


def inverted_slider_crank():
    drawn = points("A 0 0, B 0.03 0.04, D 0.15 0.03, S 0.15 0.04")
    middle = at("0.09 0.04")

    def place(now, t):
        now["B"] = drawn["B"].turned(cos(3 * t), sin(3 * t))

    def equations(p, t):
        # S is the foot of the perpendicular from D onto the rod's line.
        return [apart(p["D"], p["S"], (drawn["D"], drawn["S"])), dot(p["S"] - p["B"], p["S"] - p["D"])]

    def poses(p):
        crank = pose(drawn["A"], drawn["B"] - drawn["A"], p["A"], p["B"] - p["A"], drawn["A"])
        line, drawn_line = p["S"] - p["B"], drawn["S"] - drawn["B"]
        rod = pose(drawn["B"], drawn_line, p["B"], line, middle)
        sleeve = pose(drawn["D"], drawn_line, p["D"], line, drawn["D"])
        return crank + rod + sleeve

    return with_pins(["crank", "rod", "sleeve"], drawn, ["S"], place, equations, poses)


def platform_3rpr():
    drawn = points("A -0.8 -0.5, B 0.8 -0.5, C 0 0.9, P -0.05 -0.3, Q 0.28 0.1, R -0.23 0.2")
    legs = ["AP", "BQ", "CR"]

    def place(now, t):
        strokes = [exact("0.08") * sin(t), exact("0.06") * sin(exact("1.5") * t), -exact("0.07") * sin(2 * t)]
        for (a, p), stroke in zip(legs, strokes):
            now[a + p] = distance(drawn[a], drawn[p]) + stroke

    def equations(p, t):
        rigid = [apart(p[a], p[b], (drawn[a], drawn[b])) for a, b in ("PQ", "QR", "RP")]
        return rigid + [apart(p[a], p[b], p[a + b]) for a, b in legs]

    def poses(p):
        q = pose(drawn["P"], drawn["Q"] - drawn["P"], p["P"], p["Q"] - p["P"], Point(0, 0))
        for a, b in legs:
            angle, line = heading(drawn, a, b), drawn[b] - drawn[a]
            q += pose(drawn[a], line, p[a], p[b] - p[a], drawn[a], angle)
            q += pose(drawn[b], line, p[b], p[b] - p[a], drawn[b], angle)
        return q

    names = ["platform", "base1", "rod1", "base2", "rod2", "base3", "rod3"]
    return with_pins(names, drawn, ["P", "Q", "R"], place, equations, poses)


def scissor():
    stages = range(1, 7)
    text = "A 0 0, B 0.8 0"
    for k in stages:
        low, middle, high = 6 * (k - 1), 6 * k - 3, 6 * k
        text += f", M{k} 0.4 {middle / 10:.1f}, L{k} 0 {high / 10:.1f}, R{k} 0.8 {high / 10:.1f}"
    drawn = points(text)
    feet = {k: ("A", "B") if k == 1 else (f"L{k - 1}", f"R{k - 1}") for k in stages}

    def place(now, t):
        now["B"] = Point(exact("0.8") + exact("0.1") * sin(2 * t), 0)
        for k in stages:
            left, right = feet[k]
            # The pins on top lie as far above the middle pin as the feet lie below it.
            now[f"R{k}"] = now[f"M{k}"].scaled(2) - now[left]
            now[f"L{k}"] = now[f"M{k}"].scaled(2) - now[right]

    def equations(p, t):
        half = Jet(mpf(1) / 2)
        return [apart(p[foot], p[f"M{k}"], half) for k in stages for foot in feet[k]]

    def poses(p):
        q = [p["B"].x, p["B"].y, Jet(0)]
        for k in stages:
            middle = p[f"M{k}"]
            for top in (p[f"R{k}"], p[f"L{k}"]):
                line = top - middle
                q += [middle.x, middle.y, atan2(line.y, line.x)]
        return q

    names = ["shoe"] + [f"{kind}{k}" for k in stages for kind in ("rising", "falling")]
    return with_pins(names, drawn, [f"M{k}" for k in stages], place, equations, poses)


def stephenson():
    drawn = points("A 0 0, B -0.4 0.8, C 1 1, D 1 0, E 0.3 1.5, F 1.9 1.5, G 2 0.8")

    def place(now, t):
        swing = exact("0.3") * sin(2 * t)
        now["F"] = drawn["G"] + (drawn["F"] - drawn["G"]).turned(cos(swing), sin(swing))
        now["E"] = carried(drawn, now, "B", "C", "E")

    def equations(p, t):
        return [apart(p[a], p[b], (drawn[a], drawn[b])) for a, b in ("AB", "BC", "CD", "EF")]

    def poses(p):
        q = []
        frames = [("AB", "A"), ("BC", at("0.3 1.1")), ("DC", "D"), ("FE", "F"), ("GF", "G")]
        for (a, b), origin in frames:
            origin = drawn[origin] if isinstance(origin, str) else origin
            q += pose(drawn[a], drawn[b] - drawn[a], p[a], p[b] - p[a], origin)
        return q

    return with_pins(["crank", "coupler", "rocker", "link", "arm"], drawn, ["B", "C"], place, equations, poses)


def linkage(bodies, drawn, unknown, place, lengths):
    """Bodies `name base tip` whose frame is at the base with the x axis through the tip; `lengths` between pins, `AB 0.25`."""
    bodies = [entry.split() for entry in bodies.split(",")]
    lengths = [(pair, exact(length)) for pair, length in (entry.split() for entry in lengths.split(","))]

    def equations(p, t):
        return [apart(p[a], p[b], Jet(length)) for (a, b), length in lengths]

    def poses(p):
        q = []
        for _, base, tip in bodies:
            arm = p[tip] - p[base]
            q += [p[base].x, p[base].y, atan2(arm.y, arm.x)]
        return q

    return with_pins([name for name, _, _ in bodies], points(drawn), unknown, place, equations, poses)


def jansen():
    def place(now, t):
        now["M"] = Point(exact("0.15"), 0).turned(cos(3 * t), sin(3 * t))

    return linkage(
        "crank O M, upper M U, rocker C U, lower M W, swing C W, shank V F, foot W F",
        "O 0 0, C -0.38 -0.078, M 0.15 0, U -0.24 0.31, V -0.75 0.08, W -0.27 -0.46, F -0.59 -0.28",
        ["U", "V", "W", "F"],
        place,
        "MU 0.5, CU 0.415, CV 0.401, UV 0.558, MW 0.619, CW 0.393, VF 0.394, WF 0.367",
    )


def peaucellier():
    def place(now, t):
        swing = mp.pi / 3 * sin(2 * t)
        now["P"] = now["Q"] + Point(exact("0.075"), 0).turned(cos(swing), sin(swing))

    return linkage(
        "crank Q P, upper O A, lower O B, near_upper P A, near_lower P B, far_upper R A, far_lower R B",
        "O 0 0, Q 0.075 0, P 0.15 0, A 0.21 0.137, B 0.21 -0.137, R 0.267 0",
        ["A", "B", "R"],
        place,
        "OA 0.25, OB 0.25, PA 0.15, PB 0.15, RA 0.15, RB 0.15",
    )


def andrews():
    crank, rod, side, arm, link = (exact(v) / 1000 for v in (7, 28, 35, 40, 20))
    beta = exact("-0.0617138900142764496358948458001")
    spin = exact("14222.4439199541138705911625887")
    b, a = Point(exact("-0.03635"), exact("0.03273")), Point(exact("-0.06934"), exact("-0.00227"))

    def angle(t):
        return beta + spin / 40000 * (1 - cos(200 * t))

    def tip(t):
        return Point(crank * cos(angle(t)), crank * sin(angle(t)))

    def equations(values, t):
        e, g, h = (Point(*values[k : k + 2]) for k in (0, 2, 4))
        lengths = [(tip(t), e, rod), (b, e, side), (a, g, arm), (g, e, link), (a, h, arm), (h, e, link)]
        return [apart(p, q, Jet(length)) for p, q, length in lengths]

    def poses(values, t):
        e, g, h = (Point(*values[k : k + 2]) for k in (0, 2, 4))
        f = tip(t)

        def along(way):
            return atan2(way.y, way.x)

        def below(way):
            return atan2(way.x, -way.y)

        bodies = [
            (Point(Jet(0), Jet(0)), angle(t)),
            (f, along(f - e)),
            (b, below(e - b)),
            (g, below(e - g)),
            (a, along(g - a)),
            (h, along(e - h)),
            (a, below(h - a)),
        ]
        return [part for origin, turn in bodies for part in (origin.x, origin.y, turn)]

    start = ["-0.0209597", "0.0012979", "-0.0339972", "0.0164556", "-0.0316303", "-0.0156197"]
    names = ["k1", "k2", "k3", "k4", "k5", "k6", "k7"]
    return Mechanism(names, [exact(v) for v in start], equations, poses)


def quick_return():
    crank, lever, link, height = (exact(v) for v in ("0.1", "0.45", "0.3", "0.22"))
    pivot = Point(0, exact("-0.2"))

    def ends(t):
        tip = Point(crank, 0).turned(cos(3 * t), sin(3 * t))
        arm = tip - pivot
        angle = atan2(arm.y, arm.x)
        return angle, pivot + Point(lever, 0).turned(cos(angle), sin(angle))

    def equations(values, t):
        return [apart(ends(t)[1], Point(values[0], height), Jet(link))]

    def poses(values, t):
        (angle, b), d = ends(t), Point(values[0], height)
        rod = d - b
        return [Jet(0), Jet(0), 3 * t, pivot.x, pivot.y, angle, b.x, b.y, atan2(rod.y, rod.x), d.x, d.y, Jet(0)]

    return Mechanism(["crank", "lever", "link", "ram"], [exact("0.48")], equations, poses)


def explicit(bodies, poses, contacts=()):
    """A mechanism whose pose is a formula in t; the solver gets an unknown that is zero."""
    return Mechanism(bodies, [mpf(0)], lambda values, t: [values[0]], lambda values, t: poses(t), contacts)


def scotch_yoke():
    radius = exact("0.05")
    return explicit(["crank", "yoke"], lambda t: [Jet(0), Jet(0), 3 * t, radius * cos(3 * t), Jet(0), Jet(0)])


def double_wishbone():
    drawn = points("A 0.35 0.18, B 0.7 0.16, C 0.4 0.43, D 0.68 0.42, W 0.76 0.3")

    def equations(p, t):
        rigid = [apart(p[a], p[b], (drawn[a], drawn[b])) for a, b in ("AB", "CD", "BD")]
        travel = exact("0.3") + exact("0.06") * sin(2 * t)
        return rigid + [carried(drawn, p, "B", "D", "W").y - travel]

    def poses(p):
        q = []
        for a, b in ("AB", "CD", "BD"):
            q += pose(drawn[a], drawn[b] - drawn[a], p[a], p[b] - p[a], drawn[a])
        return q

    return with_pins(["lower", "upper", "upright"], drawn, ["B", "D"], lambda now, t: None, equations, poses)


def pantograph():
    def place(now, t):
        now["P"] = Point(exact("0.25") + exact("0.06") * sin(2 * t), exact("0.1") + exact("0.04") * sin(4 * t))
        now["A"] = now["D"].scaled(exact("2.5"))

    return linkage(
        "long O D, far A B, near D P, short B P",
        "O 0 0, D 0.07 0.19, B 0.355 0.38",
        ["D", "B"],
        place,
        "OD 0.2, DP 0.2, AB 0.2, BP 0.3",
    )


def planetary_gear():
    sun, planet, ring = 20, 15, 50

    def poses(t):
        # Willis: (w_sun - w_carrier) z_sun = -(w_ring - w_carrier) z_ring, with the ring at rest.
        carrier = 7 * t * mpf(sun) / (sun + ring)
        spin = carrier - (7 * t - carrier) * (mpf(sun) / planet)
        arm = exact("0.035")
        return [Jet(0), Jet(0), 7 * t, Jet(0), Jet(0), carrier, arm * cos(carrier), arm * sin(carrier), spin]

    return explicit(["sun", "carrier", "planet"], poses)


def rack_steering():
    drawn = points("L -0.65 0, R 0.65 0, S -0.62 -0.15, T 0.62 -0.15, U -0.3 -0.12, V 0.3 -0.12")
    centre = Point(exact("0.1"), exact("-0.112"))

    def angle(t):
        return 6 * sin(t)

    def shift(t):
        return exact("0.008") * angle(t)

    def place(now, t):
        for name in "UV":
            now[name] = drawn[name] + Point(shift(t), 0)

    def equations(p, t):
        return [apart(p[a], p[b], (drawn[a], drawn[b])) for a, b in ("LS", "RT", "SU", "TV")]

    def poses(p):
        q = []
        for a, b in ("LS", "RT"):
            q += pose(drawn[a], drawn[b] - drawn[a], p[a], p[b] - p[a], drawn[a])
        return q

    sides = with_pins(["left", "right"], drawn, ["S", "T"], place, equations, poses)
    return Mechanism(
        ["pinion", "rack", "left", "right"],
        sides.start,
        sides.equations,
        lambda values, t: [centre.x, centre.y, angle(t), shift(t), Jet(exact("-0.12")), Jet(0)] + sides.poses(values, t),
    )


def disc_cam():
    e, disc, roller = (exact(v) / 1000 for v in ("10", "30", "8"))

    def poses(t):
        angle = mp.pi / 2 + 3 * t
        height = e * sin(angle) + sqrt((disc + roller) ** 2 - (e * cos(angle)) * (e * cos(angle)))
        centre = Point(e * cos(angle), e * sin(angle))
        normal = Point(0, height) - centre
        return [Jet(0), Jet(0), angle, Jet(0), height, Jet(0), atan2(normal.y, normal.x) - angle]

    return explicit(["cam", "follower"], poses, ["s_wheel"])


def cam_dwell():
    low, high = exact("0.04"), exact("0.06")

    def height(angle):
        """The law at a jet, on the piece that holds its value."""
        turns = mp.floor(angle.c[0] / (2 * mp.pi))
        x = (angle - 2 * mp.pi * turns) * (mpf(180) / mp.pi)
        for start, end, h0, h1 in [(90, 180, low, high), (240, 360, high, low)]:
            if start <= x.c[0] < end:
                s = (x - start) * (mpf(1) / (end - start))
                return h0 + (h1 - h0) * (s - sin(2 * mp.pi * s) * (1 / (2 * mp.pi)))
        return Jet(high if 180 <= x.c[0] < 240 else low)

    def poses(t):
        return [Jet(0), Jet(0), -3 * t, height(3 * t), Jet(0), Jet(0), 3 * t]

    return explicit(["cam", "follower"], poses, ["s_tip"])


# The file of a mechanism, without its extension.
TABLES = {
    "exam": two_body,
    "excavator": excavator_pins,
    "excavator_centers": excavator_centers,
    "arm": arm,
    "four_bar": four_bar,
    "slider_crank": slider_crank,
    "inverted_slider_crank": inverted_slider_crank,
    "platform_3rpr": platform_3rpr,
    "scissor": scissor,
    "stephenson": stephenson,
    "jansen": jansen,
    "peaucellier": peaucellier,
    "andrews": andrews,
    "quick_return": quick_return,
    "scotch_yoke": scotch_yoke,
    "double_wishbone": double_wishbone,
    "pantograph": pantograph,
    "planetary_gear": planetary_gear,
    "rack_steering": rack_steering,
    "disc_cam": disc_cam,
    "cam_dwell": cam_dwell,
}


def solve(mechanism, values, time):
    """The unknowns as jets at a time, from estimates of their values."""
    t = Jet(time, 1)
    size = len(values)
    values = [Jet(value.c[0]) if isinstance(value, Jet) else Jet(value) for value in values]
    for _ in range(60):
        residual = mechanism.equations(values, t)
        if max(abs(c) for r in residual for c in r.c) < RESIDUAL:
            return values
        jacobian = matrix(size, size)
        for column in range(size):
            # The equations are quadratic, so this difference is their derivative, whatever its width.
            forward, backward = (
                mechanism.equations(
                    [Jet(v.c[0] + (side if k == column else 0)) for k, v in enumerate(values)], Jet(time)
                )
                for side in (1, -1)
            )
            for row in range(size):
                jacobian[row, column] = (forward[row].c[0] - backward[row].c[0]) / 2
        updates = [lu_solve(jacobian, matrix([-r.c[level] for r in residual])) for level in range(3)]
        values = [v + Jet(*(update[k] for update in updates)) for k, v in enumerate(values)]
    raise ArithmeticError(f"no convergence at t = {time}")


def motion(mechanism):
    """The rows t, q, q', q''."""
    values, last, rows = mechanism.start, None, []
    for step in range(END * STEPS_PER_SECOND + 1):
        time = mpf(step) / STEPS_PER_SECOND
        values = solve(mechanism, values, time)
        q = mechanism.poses(values, Jet(time, 1))
        for index in mechanism.angles():
            if last is not None:
                turns = mp.nint((last[index].c[0] - q[index].c[0]) / (2 * mp.pi))
                q[index] = q[index] + 2 * mp.pi * turns
                if abs(q[index].c[0] - last[index].c[0]) > 1:
                    raise ArithmeticError(f"the step to t = {time} is too long")
        last = q
        if step % PER_ROW == 0:
            rows.append([time] + [c.c[level] * (1, 1, 2)[level] for level in range(3) for c in q])
    return rows


def header(mechanism):
    levels = ("q", "qd", "qdd")
    return ["t"] + [f"{level}_{name}" for level in levels for name in mechanism.coordinates()]


def text(value):
    if value == 0 or abs(value) < mpf(10) ** -48:
        return "0.0"
    return mp.nstr(value, 25)


def main(arguments):
    check = "--check" in arguments
    chosen = [name for name in arguments if not name.startswith("--")] or list(TABLES)
    for name in chosen:
        mechanism = TABLES[name]()
        rows = motion(mechanism)
        file = Path(__file__).parent / f"{name}.csv"
        if check or name in ("exam", "excavator"):
            lines = file.read_text().splitlines()[1:]
            committed = [[mpf(cell) for cell in line.split(",")] for line in lines]
            largest = max(abs(a - b) / max(1, abs(a)) for ra, rb in zip(rows, committed, strict=True) for a, b in zip(ra, rb, strict=True))
            print(f"{name}: {mp.nstr(largest, 3)} from the committed table")
            if largest > mpf(10) ** -23:
                sys.exit(1)
        else:
            lines = [",".join(header(mechanism))]
            lines += [",".join([mp.nstr(row[0], 3)] + [text(value) for value in row[1:]]) for row in rows]
            file.write_text("\n".join(lines) + "\n")
            print(f"{name}: {len(rows)} rows")


if __name__ == "__main__":
    main(sys.argv[1:])
