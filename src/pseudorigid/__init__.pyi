"""The public names and their modules, for type checkers and for `__init__.py`, a line for each."""

from .dynamics.ball import Ball as Ball
from .dynamics.lyapunov import lyapunov_spectrum as lyapunov_spectrum
from .dynamics.manifolds import trace_manifold as trace_manifold
from .dynamics.motion import motion as motion
from .dynamics.newton import periodic_orbits as periodic_orbits
from .dynamics.orbits import orbit as orbit
from .dynamics.periodic import symmetric_orbits as symmetric_orbits
from .dynamics.periods import count_orbits as count_orbits
from .dynamics.quantities import classify_orbits as classify_orbits
from .dynamics.quantities import residue as residue
from .dynamics.quantities import rotation_number as rotation_number
from .dynamics.variables import with_parameters as with_parameters
from .figures.picture import Picture as Picture

__version__: str
