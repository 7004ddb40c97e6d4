"""Distance limits that may act: no limit that binds is left out."""

import mink
import mujoco
import numpy as np

from labutopia_lerobot.sim.near_bodies import NearBodies

BALLS = """
<mujoco>
  <worldbody>
    <geom name="floor" type="plane" size="1 1 1"/>
    <body name="arm" pos="0 0 1">
      <joint type="slide" axis="1 0 0"/>
      <geom size="0.01"/>
      <body name="hand"><joint type="hinge"/><geom name="hand" size="0.1"/></body>
    </body>
    <body name="near" pos="0.25 0 1"><freejoint/><geom name="near" size="0.1"/></body>
    <body name="far" pos="0.9 0 1"><freejoint/><geom name="far" size="0.1"/></body>
  </worldbody>
</mujoco>
"""


def limits(model: mujoco.MjModel) -> dict[str, mink.CollisionAvoidanceLimit]:
    """Return the limit between the hand and each of the others, which act below 0.1 m."""
    return {
        other: mink.CollisionAvoidanceLimit(
            model, [(["hand"], [other])], collision_detection_distance=0.1
        )
        for other in ("near", "far", "floor")
    }


def test_what_is_near_and_what_has_no_bounds_may_act_and_what_is_far_may_not():
    model = mujoco.MjModel.from_xml_string(BALLS)
    configuration = mink.Configuration(model)
    near = NearBodies(model, limits(model))
    assert near.at(configuration.data) == {"near", "floor"}


def test_a_limit_that_is_left_out_bounds_nothing():
    model = mujoco.MjModel.from_xml_string(BALLS)
    configuration, each = mink.Configuration(model), limits(model)
    near, seen = NearBodies(model, each), set()
    for x in np.linspace(-1.5, 1.5, 301):
        qpos = model.qpos0.copy()
        qpos[0] = x
        configuration.update(qpos)
        now = near.at(configuration.data)
        seen |= each.keys() - now
        for name in each.keys() - now:
            bound = each[name].compute_qp_inequalities(configuration, 0.1).h
            assert bound is not None
            assert np.isinf(bound).all()
    assert seen == {"near", "far"}  # each is far at times; of a plane one never knows
