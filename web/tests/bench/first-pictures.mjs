// npm run first-pictures: what the view of refinement opens on; one line of JSON for each of its panes.
import { firstPicture } from '../support/first-picture.ts';

for (const pane of await firstPicture()) console.log(JSON.stringify({ ...pane, status: 'ok' }));
