"""Pictures of sweeps over k and the energy."""
