"""What a browser is shown that comes without the token, as from a share link: how to get in, or straight in.

The page keeps the token in the browser's storage of this very address and port, so that links need not carry it. The
script takes it from there once; a token that is refused is forgotten.
"""

from __future__ import annotations

import base64
import hashlib

SCRIPT = """
const key = "bayesmap-token";
const given = new URLSearchParams(location.search).get("token");
let kept = null;
try {
  kept = localStorage.getItem(key);
  if (kept === given) localStorage.removeItem(key);
} catch {}
if (kept && kept !== given) location.replace("/?token=" + encodeURIComponent(kept) + location.hash);
if (location.hash) document.getElementById("link").hidden = false;
"""

PAGE = f"""<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<title>bayesmap</title>
<link rel="icon" href="data:,">
<style>body {{ max-width: 36em; margin: 12vh auto; padding: 0 1.5em; font: 16px/1.5 system-ui, sans-serif; }}</style>
</head>
<body>
<h1>bayesmap</h1>
<p>The token is missing or wrong: open the address that <code>bayesmap app</code> printed.</p>
<p id="link" hidden>Then open this link again: its map is shown there.</p>
<script>{SCRIPT}</script>
</body>
</html>
"""

SCRIPT_HASH = "sha256-" + base64.b64encode(hashlib.sha256(SCRIPT.encode()).digest()).decode()
"""For the policy: this script and no other may run."""
