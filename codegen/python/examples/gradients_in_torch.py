"""The rocker of a four-bar as a function that PyTorch differentiates: exact derivatives come from the mechanism."""

from pathlib import Path

import linkwright
import numpy as np
import torch

LINKAGE = linkwright.load(Path(__file__).with_name("four_bar.mech"))
TIMES = np.linspace(0.0, 2 * np.pi / 3, 61)


class Rocker(torch.autograd.Function):
    """Angles of the rocker (rad) for a length of the crank (m)."""

    @staticmethod
    def forward(ctx, length):
        ctx.save_for_backward(length)
        motion = LINKAGE(crank_length=length.item()).solve(TIMES)
        return torch.from_numpy(motion.phi_rocker.copy())

    @staticmethod
    def backward(ctx, gradient):
        (length,) = ctx.saved_tensors
        sensitivity = LINKAGE(crank_length=length.item()).sensitivity(TIMES, "crank_length")
        derivative = torch.from_numpy(sensitivity["phi_rocker", "crank_length"].copy())
        return (gradient * derivative).sum()


if __name__ == "__main__":
    length = torch.tensor(0.03, dtype=torch.float64, requires_grad=True)
    angles = Rocker.apply(length)
    (angles.max() - angles.min()).backward()
    print(f"swing {angles.max() - angles.min():.6f} rad, its derivative {length.grad:.6f} rad/m")
