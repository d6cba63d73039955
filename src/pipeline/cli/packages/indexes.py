"""The user's package indexes: settings of pip and uv that an installation keeps.

All other settings are dropped, since they could install packages elsewhere, or other packages.
"""

import ast
import os
import re
import ssl
import subprocess

# Settings of pip that choose where packages come from, and their names for uv.
_SOURCES = {
    "index-url": "UV_DEFAULT_INDEX",
    "extra-index-url": "UV_INDEX",
    "find-links": "UV_FIND_LINKS",
    "trusted-host": "UV_INSECURE_HOST",
    "cert": "SSL_CERT_FILE",
    "client-cert": "SSL_CLIENT_CERT",
    "proxy": "ALL_PROXY",
}
_PIP = (*_SOURCES, "no-index", "timeout", "default-timeout", "retries", "keyring-provider")
_UV = (
    r"UV_(\w*INDEX|FIND_LINKS|KEYRING|INSECURE_HOST|SYSTEM_CERTS|NATIVE_TLS|HTTP|CACHE_DIR"
    r"|CONFIG_FILE|CREDENTIALS|CONCURRENT|OFFLINE|REQUEST)"
)


def pip_settings(pip: list[str]) -> dict[str, str]:
    """Return the settings of pip that are kept; variables override its files."""
    variables = ["PIP_CONFIG_FILE", *map(_variable, _PIP)]
    own = {name: os.environ[name] for name in variables if name in os.environ}
    result = subprocess.run(
        [*pip, "config", "list"],
        capture_output=True,
        text=True,
        check=False,
        env=neutral_environment() | own,
    )
    settings = re.findall(r"^(global|install|:env:)\.([\w-]+)=(.+)$", result.stdout, re.M)
    settings.sort(key=lambda item: ("global", "install", ":env:").index(item[0]))
    return {name: ast.literal_eval(value) for _, name, value in settings if name in _PIP}


def _variable(setting: str) -> str:
    return f"PIP_{setting.upper().replace('-', '_')}"


def neutral_environment() -> dict[str, str]:
    """Return the present environment without variables that change what is installed, or where."""
    dropped = r"PIP_|UV_|VIRTUAL_ENV$|CONDA_PREFIX$|SETUPTOOLS_|DISTUTILS_"
    kept = {name: value for name, value in os.environ.items() if not re.match(dropped, name)}
    return kept | {"LC_ALL": "C.UTF-8"}  # setuptools reads files in the locale's encoding


def pip_environment(settings: dict[str, str]) -> dict[str, str]:
    """Return the environment for pip, in which it reads no file of settings."""
    kept = {_variable(name): value for name, value in settings.items()}
    kept |= {"PIP_CONFIG_FILE": os.devnull, "PIP_USER": "0", "PIP_NO_INPUT": "1"}
    return neutral_environment() | kept | {"PIP_DISABLE_PIP_VERSION_CHECK": "1"}


def uv_environment(settings: dict[str, str]) -> dict[str, str]:
    """Return the environment for uv: pip's settings, each overridden by uv's of the same name."""
    own = {name: value for name, value in os.environ.items() if re.match(_UV, name)}
    of_pip = {_SOURCES[name]: value for name, value in settings.items() if name in _SOURCES}
    # As pip does, search all indexes for a version; its hash decides what is installed.
    defaults = {"UV_INDEX_STRATEGY": "unsafe-best-match"}
    if ssl.get_default_verify_paths().cafile:
        defaults["UV_SYSTEM_CERTS"] = "1"
    return neutral_environment() | defaults | of_pip | own
