"""What is in a piece of HTML, for tests of what a screen reader gets."""

from html.parser import HTMLParser


class Tags(HTMLParser):
    """Every tag of a piece of HTML with its attributes, and whether all were closed."""

    def __init__(self, html):
        super().__init__()
        self.found, self.open = [], []
        self.feed(html)

    def handle_starttag(self, tag, attrs):
        """Note a tag."""
        self.found.append((tag, dict(attrs)))
        if tag != "img":
            self.open.append(tag)

    def handle_endtag(self, tag):
        """Take it off again."""
        assert self.open.pop() == tag

    def all(self, wanted):
        """The attributes of all tags of a name."""
        return [attrs for tag, attrs in self.found if tag == wanted]
