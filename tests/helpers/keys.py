"""What the keys of pictures say."""

from matplotlib.colors import to_hex

SCENE = {"ball": {"k": 0.2, "g": 0.04}, "energy": 0.01}


def texts(figure):
    return [text.get_text() for text in figure.texts]


def colors(figure):
    return {to_hex(line.get_color()) for line in figure.artists}
