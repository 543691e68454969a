"""Times NumPy and pylinkage on chains of dyads and on the four-bar.

`peers.py numpy [SETS…]` and `peers.py pylinkage` print, each on a line: `version PROGRAM VERSION`, `first MECHANISM MS`, `time METHOD MECHANISM NS`, and
`value METHOD MECHANISM NUMBERS`, by which the caller checks the last instant.
"""

import sys
import time

BEGUN = time.perf_counter()

CHAINS = [1, 7, 17]
INSTANTS = 200
STEP = 0.01
# Numbers of mechanisms in a batch, of which the fastest counts: one that fits into a cache, and that of the interpreter's batches.
SETS = [int(it) for it in sys.argv[2:]] or [32, 512]
RUNS = 7

# Pins on the ground, and tips in the design, of even and odd links.
GROUND = [(0.0, 0.0), (1.0, 0.0)]
TIP = [(0.0, 0.5), (1.1, 0.4)]

# Four-bar: crank, coupler, rocker and ground (m), first angle of the crank (rad) and its speed (rad/s).
LENGTHS = [0.04, 0.12, 0.08, 0.1]
START = 0.6981317007977318
SPEED = 3.0


def fastest(work, poses):
    """Returns the least time of a pose (ns)."""
    times = []
    for _ in range(RUNS):
        begun = time.perf_counter()
        work()
        times.append(time.perf_counter() - begun)
    return 1e9 * min(times) / poses


def since_start():
    return 1e3 * (time.perf_counter() - BEGUN)


def with_numpy():
    import numpy as np

    def chains(count, dyads):
        """Returns the pins on the ground and the tips of many equal chains: by set, link and component."""
        places = np.array([[GROUND[k % 2], TIP[k % 2]] for k in range(dyads + 1)])
        ground, tip = places[:, 0], places[:, 1]
        return np.tile(ground, (count, 1, 1)), np.tile(tip, (count, 1, 1))

    def product(cosine, sine, arm):
        """Rotates by products of matrices."""
        rows = [np.stack([cosine, -sine], axis=-1), np.stack([sine, cosine], axis=-1)]
        return np.matmul(np.stack(rows, axis=-2), arm[..., None])[..., 0]

    def elementwise(cosine, sine, arm):
        """Rotates component by component."""
        x, y = arm[..., 0], arm[..., 1]
        return np.stack([cosine * x - sine * y, sine * x + cosine * y], axis=-1)

    def positions(ground, tip, angles, rotated):
        """Returns the tips by link, set and instant: dyad by dyad, each in all sets and at all instants, by the law of cosines."""
        length = np.linalg.norm(tip[:, 0] - ground[:, 0], axis=-1)
        crank = np.stack([np.cos(angles), np.sin(angles)], axis=-1)
        tips = np.empty((tip.shape[1], len(tip), len(angles), 2))
        tips[0] = ground[:, 0, None] + length[:, None, None] * crank
        for k in range(1, tip.shape[1]):
            first = np.linalg.norm(tip[:, k] - tip[:, k - 1], axis=-1)[:, None]
            second = np.linalg.norm(tip[:, k] - ground[:, k], axis=-1)[:, None]
            drawn, link = ground[:, k] - tip[:, k - 1], tip[:, k] - tip[:, k - 1]
            side = np.sign(drawn[:, 0] * link[:, 1] - drawn[:, 1] * link[:, 0])[:, None]
            base = ground[:, k, None] - tips[k - 1]
            distance = np.linalg.norm(base, axis=-1)
            angle = side * np.arccos((distance**2 + first**2 - second**2) / (2 * distance * first))
            arm = base * (first / distance)[..., None]
            tips[k] = tips[k - 1] + rotated(np.cos(angle), np.sin(angle), arm)
        return tips

    def four_bar(lengths, t):
        """Returns all coordinates that move, their rates and their accelerations, by set and instant."""
        crank, coupler, rocker, ground = lengths
        angle = START + SPEED * t
        cosine, sine = np.cos(angle), np.sin(angle)
        x, y = crank * cosine, crank * sine
        base_x, base_y = ground - x, -y
        square = base_x * base_x + base_y * base_y
        along = 0.5 * (square + coupler**2 - rocker**2)
        across = np.sqrt(coupler**2 * square - along * along)
        link_x = (along * base_x - across * base_y) / square
        link_y = (along * base_y + across * base_x) / square
        rest_x, rest_y = base_x - link_x, base_y - link_y
        inverse = 1.0 / (link_x * rest_y - link_y * rest_x)
        rate_x, rate_y = -SPEED * y, SPEED * x
        coupler_rate = -(rate_x * rest_x + rate_y * rest_y) * inverse
        rocker_rate = (rate_x * link_x + rate_y * link_y) * inverse
        acceleration_x, acceleration_y = -SPEED * rate_y, SPEED * rate_x
        load_x = coupler_rate**2 * link_x + rocker_rate**2 * rest_x - acceleration_x
        load_y = coupler_rate**2 * link_y + rocker_rate**2 * rest_y - acceleration_y
        coupler_acceleration = (load_x * rest_x + load_y * rest_y) * inverse
        rocker_acceleration = -(load_x * link_x + load_y * link_y) * inverse
        coupler_angle, rocker_angle = np.arctan2(link_y, link_x), np.arctan2(-rest_y, -rest_x)
        return [
            [angle, x, y, coupler_angle, rocker_angle],
            [SPEED, rate_x, rate_y, coupler_rate, rocker_rate],
            [0.0, acceleration_x, acceleration_y, coupler_acceleration, rocker_acceleration],
        ]

    t = STEP * np.arange(INSTANTS)
    angles = np.pi / 2 + 0.3 * np.sin(t)
    ground, tip = chains(8, 1)
    positions(ground, tip, angles, product)
    print(f"version NumPy {np.__version__}")
    print(f"first dyads_1 {since_start():.3f}")
    for name, rotated in [("product", product), ("elementwise", elementwise)]:
        for dyads in CHAINS:
            times = []
            for count in SETS:
                ground, tip = chains(count, dyads)
                poses = count * INSTANTS
                times.append(fastest(lambda: positions(ground, tip, angles, rotated), poses))
            x, y = positions(ground, tip, angles, rotated)[-1, 0, -1]
            print(f"time {name} dyads_{dyads} {min(times):.3f}")
            print(f"value {name} dyads_{dyads} {float(x)!r} {float(y)!r}")
    times = []
    for count in SETS:
        lengths = [np.full((count, 1), length) for length in LENGTHS]
        times.append(fastest(lambda: four_bar(lengths, t), count * INSTANTS))
    values = [float(level[4][0, -1]) for level in four_bar(lengths, t)]
    print(f"time closed four_bar {min(times):.3f}")
    print("value closed four_bar", *(repr(value) for value in values))


def with_pylinkage():
    import numba
    import pylinkage
    from pylinkage.actuators import Crank
    from pylinkage.components import Ground
    from pylinkage.dyads import RRRDyad
    from pylinkage.simulation import Linkage

    def distance(one, other):
        return ((one[0] - other[0]) ** 2 + (one[1] - other[1]) ** 2) ** 0.5

    def four_bar():
        crank, coupler, rocker, ground = LENGTHS
        supports = [Ground(0.0, 0.0), Ground(ground, 0.0)]
        driver = Crank(supports[0], crank, SPEED * STEP, START)
        # Near the tip in the design, which decides the assembly mode.
        pin = RRRDyad(driver.output, supports[1], coupler, rocker, x=0.143, y=0.067)
        return Linkage([*supports, driver, pin])

    def chain(dyads):
        """Returns a chain whose crank turns by 0.3 rad in all instants together."""
        supports = [Ground(*GROUND[k % 2]) for k in range(dyads + 1)]
        links = [Crank(supports[0], distance(GROUND[0], TIP[0]), 0.3 / INSTANTS, 1.5707963267948966)]
        for k in range(1, dyads + 1):
            tips, pin = [TIP[(k - 1) % 2], TIP[k % 2]], GROUND[k % 2]
            lengths = distance(*tips), distance(tips[1], pin)
            before = links[-1].output if k == 1 else links[-1]
            links.append(RRRDyad(before, supports[k], *lengths, x=tips[1][0], y=tips[1][1]))
        return Linkage([*supports, *links])

    def both_ways(linkage):
        """Goes forth and back, so that the next run begins where this one did."""
        linkage.step_fast(INSTANTS, dt=1.0)
        linkage.step_fast(INSTANTS, dt=-1.0)

    four_bar().step_fast(INSTANTS)
    print(f"version pylinkage {pylinkage.__version__}")
    print(f"version numba {numba.__version__}")
    print(f"first four_bar {since_start():.3f}")
    chains = {f"dyads_{dyads}": chain(dyads) for dyads in CHAINS}
    for name, linkage in {"four_bar": four_bar(), **chains}.items():
        x, y = linkage.step_fast(INSTANTS)[-1, -1]
        linkage.step_fast(INSTANTS, dt=-1.0)
        runs = 10
        work = lambda: [both_ways(linkage) for _ in range(runs)]
        print(f"time step_fast {name} {fastest(work, 2 * runs * INSTANTS):.3f}")
        print(f"value step_fast {name} {float(x)!r} {float(y)!r}")


{"numpy": with_numpy, "pylinkage": with_pylinkage}[sys.argv[1]]()
