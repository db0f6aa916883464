#!/usr/bin/env python3
"""Follows every link of the built site: check_site.py FOLDER.

Fails if a link leads to a missing file or anchor, if no link leads to a page, and if a page would fetch a script, a style, a font or
a picture from the net.
"""

import re
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

FETCHED = {"img": ("src", "srcset"), "script": ("src",), "source": ("src", "srcset"), "iframe": ("src",), "video": ("src",), "link": ("href",),
           "object": ("data",), "embed": ("src",), "image": ("href", "xlink:href"), "use": ("href", "xlink:href")}
UNFETCHED_LINKS = {"canonical", "next", "prev", "author", "license"}
STYLE_URL = re.compile(r"url\(\s*['\"]?([^'\")]+)|@import\s+['\"]([^'\"]+)")


class Page(HTMLParser):
    def __init__(self, text):
        super().__init__(convert_charrefs=True)
        self.anchors, self.links, self.fetched, self.in_style = set(), [], [], False
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        has = dict(attributes)
        self.in_style = tag == "style"
        self.anchors |= {has[key] for key in ("id", "name") if has.get(key)}
        if tag == "a" and has.get("href") is not None:
            self.links.append(has["href"])
        if tag == "link" and UNFETCHED_LINKS & set((has.get("rel") or "").split()):
            return
        self.fetched += [has[key] for key in FETCHED.get(tag, ()) if has.get(key)]
        if has.get("style"):
            self.fetched += style_urls(has["style"])

    def handle_endtag(self, tag):
        self.in_style = False

    def handle_data(self, data):
        if self.in_style:
            self.fetched += style_urls(data)


def style_urls(text):
    return [first or second for first, second in STYLE_URL.findall(text)]


def target(folder, page, url):
    """The (file, anchor) of a link; None if it leaves the site."""
    parts = urlsplit(url)
    if parts.scheme or parts.netloc:
        return None
    path = unquote(parts.path)
    file = (page.parent / path).resolve() if path else page
    return (file / "index.html" if file.is_dir() else file), unquote(parts.fragment)


def findings(folder):
    folder = folder.resolve()
    pages = {path: Page(path.read_text(encoding="utf-8", errors="replace")) for path in sorted(folder.rglob("*.html"))}
    reached = {folder / "index.html"}
    for path, page in pages.items():
        name = path.relative_to(folder)
        for url in page.fetched:
            if urlsplit(url).scheme in ("http", "https") or url.startswith("//"):
                yield f"{name}: fetches {url} from the net"
        for url in page.links + page.fetched:
            to = target(folder, path, url)
            if to is None:
                continue
            file, anchor = to
            if file != path:
                reached.add(file)
            if not file.exists():
                yield f"{name}: leads to {url}, which is not there"
            elif not file.is_relative_to(folder):
                yield f"{name}: leads out of the site: {url}"
            elif anchor and file in pages and anchor not in pages[file].anchors:
                yield f"{name}: leads to {url}, but {file.relative_to(folder)} has no anchor '{anchor}'"
    for path in folder.rglob("*.css"):
        for url in style_urls(path.read_text(encoding="utf-8", errors="replace")):
            if urlsplit(url).scheme in ("http", "https") or url.startswith("//"):
                yield f"{path.relative_to(folder)}: fetches {url} from the net"
    for path in sorted(set(pages) - reached):
        yield f"{path.relative_to(folder)}: no page leads here"


def main(arguments):
    folder = Path(arguments[0])
    if not (folder / "index.html").is_file():
        print(f"check_site: {folder} has no index.html, expected a site that ./dev site built")
        return 1
    found = sorted(set(findings(folder)))
    print(*found, sep="\n", end="\n" if found else "")
    if not found:
        print(f"site: {sum(1 for _ in folder.rglob('*.html'))} pages, every link leads somewhere: {folder}/index.html")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
