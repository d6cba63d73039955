"""The user's package indexes: the settings of pip and uv that an installation takes over.

All other settings of theirs could install packages elsewhere, or other ones, and are left out.
"""

import ast
import os
import re
import ssl
import subprocess
from pathlib import Path

# Settings of pip that choose where packages come from, and their names for uv.
SOURCES = {
    "index-url": "UV_DEFAULT_INDEX",
    "extra-index-url": "UV_INDEX",
    "find-links": "UV_FIND_LINKS",
    "trusted-host": "UV_INSECURE_HOST",
    "cert": "SSL_CERT_FILE",
    "client-cert": "SSL_CLIENT_CERT",
    "proxy": "ALL_PROXY",
}
OF_PIP = (*SOURCES, "no-index", "timeout", "default-timeout", "retries", "keyring-provider")
# The same for uv's own settings; others could install elsewhere, or something else.
OF_UV = r"UV_(\w*INDEX|FIND_LINKS|KEYRING|INSECURE_HOST|SYSTEM_CERTS|NATIVE_TLS|HTTP|CACHE_DIR"
OF_UV += r"|CONFIG_FILE|CREDENTIALS|CONCURRENT|OFFLINE|REQUEST)"


def pip_settings(pip):
    """Where pip takes packages from: its files' settings, over which its variables go."""
    variables = ["PIP_CONFIG_FILE", *map(_variable, OF_PIP)]
    own = {name: os.environ[name] for name in variables if name in os.environ}
    said = subprocess.run(
        [*pip, "config", "list"],
        capture_output=True,
        text=True,
        check=False,
        env=neutral_environment() | own,
    )
    found = re.findall(r"^(global|install|:env:)\.([\w-]+)=(.+)$", said.stdout, re.M)
    found.sort(key=lambda item: ("global", "install", ":env:").index(item[0]))
    return {name: ast.literal_eval(value) for _, name, value in found if name in OF_PIP}


def _variable(setting):
    """The environment variable of a setting of pip."""
    return f"PIP_{setting.upper().replace('-', '_')}"


def neutral_environment():
    """The present environment without what would install elsewhere, or something else."""
    others = r"PIP_|UV_|VIRTUAL_ENV$|CONDA_PREFIX$|SETUPTOOLS_|DISTUTILS_"
    kept = {name: value for name, value in os.environ.items() if not re.match(others, name)}
    return kept | {"LC_ALL": "C.UTF-8"}  # setuptools asks the locale


def pip_environment(settings):
    """The environment for pip, which reads no file of settings in it."""
    theirs = {_variable(name): value for name, value in settings.items()}
    theirs |= {"PIP_CONFIG_FILE": os.devnull, "PIP_USER": "0", "PIP_NO_INPUT": "1"}
    return neutral_environment() | theirs | {"PIP_DISABLE_PIP_VERSION_CHECK": "1"}


def uv_environment(settings):
    """The environment for uv: its own settings, or where there are none those of pip."""
    own = {name: value for name, value in os.environ.items() if re.match(OF_UV, name)}
    home = os.environ.get("XDG_CONFIG_HOME") or Path.home() / ".config"
    files = [Path(home, "uv", "uv.toml"), Path("/etc/uv/uv.toml"), Path("/etc/xdg/uv/uv.toml")]
    theirs = {SOURCES[name]: value for name, value in settings.items() if name in SOURCES}
    if any("INDEX" in name or name == "UV_CONFIG_FILE" for name in own) or any(
        file.exists() for file in files
    ):
        theirs = {}
    # pip looks for a version in all indexes; what it is, its hash decides.
    usual = {"UV_INDEX_STRATEGY": "unsafe-best-match"}
    if ssl.get_default_verify_paths().cafile:
        usual["UV_SYSTEM_CERTS"] = "1"
    return neutral_environment() | usual | theirs | own
