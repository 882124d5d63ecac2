"""The interactive page: a session that holds the document, a worker that infers, a server and a widget that show it."""
