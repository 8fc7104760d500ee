'use strict';
// The page begins, and watches whether what it shows is new.

setInterval(() => {
  if (!state || !state.phase || state.phase.startsWith('ended') || !socket || socket.readyState !== WebSocket.OPEN) return;
  const silent_ms = performance.now() - came_ms;
  if (silent_ms < silence_ms) return;
  document.body.classList.add('stale');
  alarm(t('shell.silent', { seconds: figure(silent_ms / 1000) }));
}, 250);
make_language();
connect();
requestAnimationFrame(draw);
