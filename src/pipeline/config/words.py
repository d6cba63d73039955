"""The one line that says what is wrong in the config and what is allowed."""


class ConfigError(Exception):
    """One line about what is wrong in the config and what is allowed."""


def refusal(place, value, allowed) -> ConfigError:
    where = f"{dotted(place)}: " if place else ""
    return ConfigError(f"{where}{shown(value)} is not allowed: expected {allowed}")


def dotted(place) -> str:
    text = ""
    for part in place:
        text += f"[{part}]" if isinstance(part, int) else f".{part}"
    return text.removeprefix(".")


def shown(value) -> str:
    text = "nothing" if value is None else repr(value) if value not in (True, False) else ""
    text = text or str(value).lower()
    return text if len(text) <= 60 else text[:57] + "..."
