"""A simulated robot that makes run files as a controller would log them, to try identification and diagnosis on
blind.

It shares no code with what it tries: ``generator`` and ``identification`` are not imported (``tests/test_plant.py``
checks it). Rigid bodies, laws of friction and of all other effects, the control loop and the sensors are its own, in
C (``c/``) that the C compiler builds on first use and keeps in the folder of temporary files, for every change of its
text anew.

    from pathlib import Path
    from tests.plant.effect import Effect
    from tests.plant.robots import ROBOTS
    from tests.plant.run import write_csv
    from tests.plant.simulate import make_run
    from tests.plant.trajectories.fourier import fourier

    run = make_run(ROBOTS["kr500_like"], fourier(seed=1), [Effect("stribeck", joint=3)], seed=2)
    write_csv(run, Path("A.csv"))

What a robot is: ``robots/NAME.py``, plain data of ``robot.py``. It moves by ``trajectories/``. It has viscous and
Coulomb friction and an offset on every joint, rotor inertia, and effects of its own (a balancer, a coupled wrist):
``simulate.own_effects``; ``own=`` plays another choice. ``robot_file.robot_file`` writes what is known of it as a
robot file.

What may be hidden in it: ``laws/NAME.py``, one law each, whose docstring says what it is; ``Effect(law, joint,
size)`` puts one to work. ``size`` is in the unit of the law and scales it continuously to nothing; ``Effect.amount``
is the typical one where none is given. Laws marked ``outside`` are meant to be in no library. Several laws are not
what a textbook's candidate is: friction reverses over a stiff bristle, Stribeck's curve comes with LuGre's lag,
gradual friction is an arctangent, ripple wanders, warm-up has two time constants.

How a run is made: the robot starts on the reference; ``Trajectory.before`` is played and not logged. Cascade control
(P of the position, PI of the speed, at 2 kHz, from quantised motor angles) asks currents of clipped amplifiers with a
first-order lag. Elastic drive trains have motors and links as states of their own. Integration is of second order, in
steps of at most 0.125 ms and short against the fastest drive train. Currents flow continuously, so that a logged
current is the one of the logged instant.

What is logged: ``run.py``. Currents get noise of a stated spectrum (``Noise.shape``), relative to their rms
(``Sensors.noise``); the truth without it is ``Run.truth``. Only what is in the files of ``write_csv`` is fair to give
to a diagnosis.

How large an effect is: ``size.py``. ``effect_torque`` is what it adds to the logged torque along the logged motion,
``whitened_size`` its rms over the noise's, both whitened by the true spectrum, after projection on columns that the
caller gives; ``scale_effect`` finds the size for a wanted one.
"""
