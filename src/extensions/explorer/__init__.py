"""Interactive page: the kernel in JavaScript, the data that it shows, and the command."""
