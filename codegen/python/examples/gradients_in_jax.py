"""A length by gradient descent in JAX: exact derivatives come from the mechanism.

The coupler of a four-bar is to turn its rocker through 60° while the crank turns once.
"""

from pathlib import Path

import jax
import jax.numpy as jnp
import linkwright
import numpy as np

jax.config.update("jax_enable_x64", True)

LINKAGE = linkwright.load(Path(__file__).with_name("four_bar.mech"))
TIMES = np.linspace(0.0, 2 * np.pi / 3, 61)
SHAPE = jax.ShapeDtypeStruct(TIMES.shape, jnp.float64)


@jax.custom_jvp
def rocker(length):
    """Angles of the rocker (rad) for a length of the crank (m)."""

    def solved(length):
        sets = {"crank_length": np.atleast_1d(length)}
        return LINKAGE.solve(TIMES, sets, outputs=["phi_rocker"])["phi_rocker"].reshape(-1)

    return jax.pure_callback(solved, SHAPE, length)


@rocker.defjvp
def rocker_jvp(primals, tangents):
    (length,), (tangent,) = primals, tangents

    def derivative(length):
        mechanism = LINKAGE(crank_length=float(length))
        return mechanism.sensitivity(TIMES, "crank_length")["phi_rocker", "crank_length"]

    return rocker(length), jax.pure_callback(derivative, SHAPE, length) * tangent


def loss(length):
    angles = rocker(length)
    return (angles.max() - angles.min() - jnp.pi / 3) ** 2


def fitted(length: float = 0.03) -> float:
    """Return the length of the crank (m) that turns the rocker through 60°."""
    slope = jax.grad(lambda it: rocker(it).max() - rocker(it).min())
    for _ in range(8):
        # A step of Newton's method.
        length -= float(jax.grad(loss)(length) / (2 * slope(length) ** 2))
    return length


if __name__ == "__main__":
    print(f"crank of {1e3 * fitted():.4f} mm")
