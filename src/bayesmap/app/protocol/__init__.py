"""The messages between page, session and worker, each declared once. `make page` writes the page's types from them."""
