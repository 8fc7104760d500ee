'use strict';
// The page begins, and watches whether what it shows is new.

setInterval(() => {
  if (!state || !state.phase || state.phase.startsWith('ended') || !socket || socket.readyState !== WebSocket.OPEN) return;
  const silent_ms = performance.now() - came_ms;
  if (silent_ms < silence_ms) return;
  document.body.classList.add('stale');
  alarm(`No word from the drive for ${(silent_ms / 1000).toFixed(0)} s: what is shown is old.`);
}, 250);
connect();
requestAnimationFrame(draw);
